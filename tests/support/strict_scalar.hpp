#pragma once
// A double in a class that converts to nothing and is made explicitly only. What compiles with it
// computes nothing in `double` on the way and finds its mathematics by argument-dependent lookup.
// It does what double does in the same order, so that results agree bit for bit (unless a compiler
// fuses multiplications into additions, which g++ and clang do not on plain x86-64).

#include <Eigen/Core>
#include <cmath>
#include <compare>
#include <limits>

namespace wheelrail_test {

class StrictScalar {
 public:
  constexpr StrictScalar() = default;
  constexpr explicit StrictScalar(double value) : value_(value) {}

  // The one way out, for the tests to compare with.
  [[nodiscard]] constexpr double as_double() const { return value_; }

  constexpr StrictScalar& operator+=(const StrictScalar& other) {
    value_ += other.value_;
    return *this;
  }
  constexpr StrictScalar& operator-=(const StrictScalar& other) {
    value_ -= other.value_;
    return *this;
  }
  constexpr StrictScalar& operator*=(const StrictScalar& other) {
    value_ *= other.value_;
    return *this;
  }
  constexpr StrictScalar& operator/=(const StrictScalar& other) {
    value_ /= other.value_;
    return *this;
  }

  friend constexpr StrictScalar operator-(const StrictScalar& a) { return StrictScalar(-a.value_); }
  friend constexpr StrictScalar operator+(StrictScalar a, const StrictScalar& b) { return a += b; }
  friend constexpr StrictScalar operator-(StrictScalar a, const StrictScalar& b) { return a -= b; }
  friend constexpr StrictScalar operator*(StrictScalar a, const StrictScalar& b) { return a *= b; }
  friend constexpr StrictScalar operator/(StrictScalar a, const StrictScalar& b) { return a /= b; }

  friend constexpr bool operator==(const StrictScalar&, const StrictScalar&) = default;
  friend constexpr std::partial_ordering operator<=>(const StrictScalar&,
                                                     const StrictScalar&) = default;

  friend StrictScalar sqrt(const StrictScalar& a) { return StrictScalar(std::sqrt(a.value_)); }
  friend StrictScalar sin(const StrictScalar& a) { return StrictScalar(std::sin(a.value_)); }
  friend StrictScalar cos(const StrictScalar& a) { return StrictScalar(std::cos(a.value_)); }
  friend StrictScalar tan(const StrictScalar& a) { return StrictScalar(std::tan(a.value_)); }
  friend StrictScalar asin(const StrictScalar& a) { return StrictScalar(std::asin(a.value_)); }
  friend StrictScalar acos(const StrictScalar& a) { return StrictScalar(std::acos(a.value_)); }
  friend StrictScalar atan(const StrictScalar& a) { return StrictScalar(std::atan(a.value_)); }
  friend StrictScalar atan2(const StrictScalar& a, const StrictScalar& b) {
    return StrictScalar(std::atan2(a.value_, b.value_));
  }
  friend StrictScalar exp(const StrictScalar& a) { return StrictScalar(std::exp(a.value_)); }
  friend StrictScalar log(const StrictScalar& a) { return StrictScalar(std::log(a.value_)); }
  friend StrictScalar pow(const StrictScalar& a, const StrictScalar& b) {
    return StrictScalar(std::pow(a.value_, b.value_));
  }
  friend StrictScalar abs(const StrictScalar& a) { return StrictScalar(std::abs(a.value_)); }

 private:
  double value_ = 0.0;
};

}  // namespace wheelrail_test

namespace Eigen {

template <>
struct NumTraits<wheelrail_test::StrictScalar> : GenericNumTraits<wheelrail_test::StrictScalar> {
  using Scalar = wheelrail_test::StrictScalar;
  using Real = Scalar;
  using NonInteger = Scalar;
  using Nested = Scalar;
  using Literal = Scalar;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
  static constexpr Scalar epsilon() { return Scalar(std::numeric_limits<double>::epsilon()); }
  static constexpr Scalar dummy_precision() { return Scalar(1e-12); }
  static constexpr Scalar highest() { return Scalar(std::numeric_limits<double>::max()); }
  static constexpr Scalar lowest() { return Scalar(std::numeric_limits<double>::lowest()); }
  static constexpr int digits10() { return std::numeric_limits<double>::digits10; }
};

}  // namespace Eigen
