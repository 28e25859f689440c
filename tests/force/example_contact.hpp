#pragma once
// The contact that tests of the creep forces look at.

#include <wheelrail/force/polach.hpp>

namespace wheelrail_test {

// 50 kN, friction 0.25, semi-axes 6 and 4.5 mm, G = 206 GPa / 2.592.
template <class T>
wheelrail::PolachContact<T> example() {
  return {{T(6e-3), T(4.5e-3)},
          {T(4.61805088), T(4.17424032), T(1.88638784), T(0)},
          T(206e9) / T(2.592),
          T(0.25),
          T(50e3)};
}

}  // namespace wheelrail_test
