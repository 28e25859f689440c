#include <numeric>
#include <wheelrail/core/fixed_list.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"

using namespace wheelrail;

TEST_CASE("FixedList: empty at first, full at its capacity, in order of insertion", "[core]") {
  FixedList<int, 3> list;
  STATIC_REQUIRE(list.capacity() == 3);
  CHECK(list.empty());
  CHECK(list.begin() == list.end());
  for (int i = 0; i < 3; ++i) {
    CHECK_FALSE(list.full());
    CHECK(list.push_back(10 + i));
    CHECK(list.size() == static_cast<std::size_t>(i + 1));
  }
  CHECK(list.full());
  CHECK_FALSE(list.empty());
  for (std::size_t i = 0; i < 3; ++i) CHECK(list[i] == 10 + static_cast<int>(i));
  CHECK(std::accumulate(list.begin(), list.end(), 0) == 33);
}

TEST_CASE("FixedList: push_back on a full list says false and changes nothing", "[core]") {
  FixedList<int, 2> list;
  REQUIRE(list.push_back(1));
  REQUIRE(list.push_back(2));
  CHECK_FALSE(list.push_back(3));
  CHECK(list.size() == 2);
  CHECK(list[0] == 1);
  CHECK(list[1] == 2);
}

TEST_CASE("FixedList: elements can be changed; clear makes room again", "[core]") {
  FixedList<int, 2> list;
  REQUIRE(list.push_back(1));
  REQUIRE(list.push_back(2));
  list[0] = 7;
  for (int& element : list) ++element;
  const auto& constant_list = list;
  CHECK(constant_list[0] == 8);
  CHECK(*(constant_list.end() - 1) == 3);
  list.clear();
  CHECK(list.empty());
  CHECK(list.push_back(5));
  CHECK(list[0] == 5);
  CHECK(list.size() == 1);
}

TEST_CASE("FixedList: works in a constant expression", "[core]") {
  constexpr std::size_t size = [] {
    FixedList<int, 4> list;
    const bool pushed = list.push_back(1) && list.push_back(2);
    return pushed ? list.size() : 0U;
  }();
  STATIC_REQUIRE(size == 2);
}

TEST_CASE("FixedList: no allocation", "[core][no-alloc]") {
  std::size_t size = 0;
  CHECK(wheelrail_test::allocations_of([&] {
          FixedList<double, 8> list;
          for (int i = 0; i < 10; ++i) {
            if (!list.push_back(i)) size = list.size();
          }
        }) == 0);
  CHECK(size == 8);
  // The counter does count.
  CHECK(wheelrail_test::allocations_of([] { ::operator delete(::operator new(8)); }) == 1);
}
