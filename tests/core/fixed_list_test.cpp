#include <numeric>
#include <string>
#include <utility>
#include <wheelrail/core/fixed_list.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"

using namespace wheelrail;

namespace {

// Cannot be made without a value, and counts what lives, what was copied and what was moved.
class Counted {
 public:
  explicit Counted(int value) : value_(value) { ++living; }
  Counted(const Counted& other) : value_(other.value_) { ++living, ++copied; }
  Counted(Counted&& other) noexcept : value_(std::exchange(other.value_, -1)) { ++living, ++moved; }
  Counted& operator=(const Counted&) = delete;
  Counted& operator=(Counted&&) = delete;
  ~Counted() { --living; }

  [[nodiscard]] int value() const { return value_; }

  static inline int living = 0, copied = 0, moved = 0;

 private:
  int value_;
};

FixedList<Counted, 8> counted(int first, int size) {
  FixedList<Counted, 8> list;
  for (int i = 0; i < size; ++i) REQUIRE(list.push_back(Counted(first + i)));
  return list;
}

}  // namespace

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

TEST_CASE("FixedList: push_back_made makes elements in their place, and none when full", "[core]") {
  struct Fixed {  // can be neither copied nor moved
    explicit Fixed(int value_) : value(value_) {}
    Fixed(const Fixed&) = delete;
    Fixed& operator=(const Fixed&) = delete;
    int value;
  };
  FixedList<Fixed, 2> list;
  int made = 0;
  const auto make = [&made] { return Fixed(++made); };
  CHECK(list.push_back_made(make));
  CHECK(list.push_back_made(make));
  CHECK_FALSE(list.push_back_made(make));
  CHECK(made == 2);
  CHECK(list.size() == 2);
  CHECK(list[0].value == 1);
  CHECK(list[1].value == 2);
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

TEST_CASE("FixedList: copies and moves hold the elements, and the copy is its own", "[core]") {
  FixedList<std::string, 3> list;
  REQUIRE(list.push_back("a string too long for the small buffer"));
  REQUIRE(list.push_back("b"));
  REQUIRE(list.push_back(list[0]));
  FixedList<std::string, 3> copy(list);
  list[1] = std::string("c");
  REQUIRE(copy.size() == 3);
  CHECK(copy[0] == "a string too long for the small buffer");
  CHECK(copy[1] == "b");
  CHECK(copy[2] == copy[0]);
  copy = list;
  CHECK(copy[1] == "c");
  const auto& same = copy;
  copy = same;
  CHECK(copy.size() == 3);
  CHECK(copy[2] == list[2]);
  list.clear();
  copy = list;
  CHECK(copy.empty());
  REQUIRE(list.push_back("d"));
  FixedList<std::string, 3> moved(std::move(list));
  copy = std::move(moved);
  REQUIRE(copy.size() == 1);
  CHECK(copy[0] == "d");
}

TEST_CASE("FixedList: what is in the list lives, nothing else, and each element is copied once",
          "[core]") {
  REQUIRE(Counted::living == 0);
  {
    FixedList<Counted, 8> list = counted(10, 3);
    CHECK(Counted::living == 3);
    Counted::copied = Counted::moved = 0;
    FixedList<Counted, 8> copy(list);
    CHECK(Counted::living == 6);
    CHECK(Counted::copied == 3);
    CHECK(copy[2].value() == 12);
    const auto& same = copy;
    copy = same;
    CHECK(Counted::copied == 3);
    CHECK(copy[2].value() == 12);

    FixedList<Counted, 8> other = counted(20, 5);
    Counted::copied = Counted::moved = 0;
    copy = other;
    CHECK(Counted::living == 3 + 5 + 5);
    CHECK(Counted::copied == 5);
    CHECK(copy[4].value() == 24);
    copy = list;
    CHECK(Counted::living == 3 + 3 + 5);
    CHECK(copy[2].value() == 12);

    Counted::copied = 0;
    FixedList<Counted, 8> taken(std::move(other));
    copy = std::move(list);
    CHECK(Counted::copied == 0);
    CHECK(Counted::moved == 5 + 3);
    CHECK(taken[4].value() == 24);
    CHECK(copy[2].value() == 12);
    taken.clear();
    CHECK(Counted::living == 3 + 3 + 5);
    CHECK(taken.push_back(Counted(1)));
    CHECK(taken[0].value() == 1);
  }
  CHECK(Counted::living == 0);
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
