#pragma once
// Derivatives by differences, as a check of derivatives in closed form.

namespace wheelrail_test {

// f'(x) from four values, exact for polynomials up to degree 4: the error is h^4/30 f^(5) and a few
// rounding units of f over h.
template <class T, class Function>
[[nodiscard]] T central_difference(const Function& f, const T& x, const T& h) {
  const T near = f(T(x + h)) - f(T(x - h));
  const T far = f(T(x + h + h)) - f(T(x - h - h));
  return (T(8) * near - far) / (T(12) * h);
}

}  // namespace wheelrail_test
