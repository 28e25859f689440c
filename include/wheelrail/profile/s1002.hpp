#pragma once
/// @file
/// The S1002 wheel profile (UIC 510-2, EN 13715): the numbers of the standard, in mm, and what is
/// built from them, in m. Lateral zero is the tread circle; the flange back is at -70 mm.
/// May include: core, numerics, profile.

#include <array>
#include <vector>
#include <wheelrail/profile/piecewise_profile.hpp>

namespace wheelrail {

/// The standard rounds its coefficients, so that neighbouring sections do not quite meet: by
/// 0.037 um at -26 mm and 0.118 um at -35 mm.
enum class S1002Form {
  closed,   ///< section C carries a cubic that makes both of its joints C1 (the default)
  standard  ///< the standard's own numbers, with their jumps
};

namespace detail {

// The polynomials of the sections B and C [mm], in powers of the lateral coordinate [mm].
inline constexpr std::array<long double, 9> s1002_section_b{0.0L,
                                                            -0.03358537058L,
                                                            0.001565681624L,
                                                            -2.810427944e-05L,
                                                            5.844240864e-08L,
                                                            -1.562379023e-08L,
                                                            5.309217349e-15L,
                                                            -5.957839843e-12L,
                                                            2.646656573e-13L};
inline constexpr std::array<long double, 9> s1002_section_c{
    -4320.221063L,    -1038.384026L,     -106.5501873L,    -6.051367875L, -0.2054332446L,
    -0.004169739389L, -4.687195829e-05L, -2.25275554e-07L, 0.0L};
// Added to section C, in powers of lateral + 35 mm [mm]: closes its jumps in value and slope at -35
// and -26 mm, and adds at most 2.9e-6 /mm of second derivative.
inline constexpr std::array<long double, 9> s1002_closing_cubic{
    1.183283218413e-4L, -7.717735072688e-6L, -9.563564897035e-7L, 8.936086364980e-8L};

// Coefficients in powers of (lateral - origin) / scale, from those in powers of (lateral -
// old_origin): a repeated synthetic division. Section C about zero would cancel four digits.
[[nodiscard]] constexpr std::array<long double, 9> recentred(std::array<long double, 9> c,
                                                             long double old_origin,
                                                             long double origin,
                                                             long double scale) {
  const long double shift = origin - old_origin;
  for (std::size_t k = 0; k + 1 < c.size(); ++k) {
    for (std::size_t j = c.size() - 1; j > k; --j) c[j - 1] += shift * c[j];
  }
  long double power = 1.0L;
  for (auto& coefficient : c) {
    coefficient *= power;
    power *= scale;
  }
  return c;
}

// A section's piece [m] from its polynomial in mm, recentred on centre and scaled by half_width.
template <Real T>
[[nodiscard]] ProfilePiece<T> s1002_polynomial(const T& lower, const T& upper, long double centre,
                                               long double half_width,
                                               const std::array<long double, 9>& centred) {
  std::array<T, 9> coefficients;
  for (std::size_t k = 0; k < 9; ++k) coefficients[k] = constant<T>(centred[k] * 1e-3L);
  return ProfilePiece<T>::polynomial(lower, upper, constant<T>(centre * 1e-3L),
                                     constant<T>(half_width * 1e-3L), coefficients);
}

}  // namespace detail

/// The S1002 profile from the flange back, where it ends 1 um short of the vertical tangent, to
/// +60 mm: sections H, G, F (flange), E (flange face, 70 deg), D (fillet R13), C, B, A (tread).
/// @return F [m] over lateral [m]: rolling radius = nominal radius + F. Source: UIC 510-2.
template <Real T>
[[nodiscard]] PiecewiseProfile<T> s1002(S1002Form form = S1002Form::closed) {
  using Piece = ProfilePiece<T>;
  using detail::recentred;
  constexpr long double mm = 1e-3L;
  constexpr auto section_b = recentred(detail::s1002_section_b, 0.0L, 3.07898L, 29.07898L);
  constexpr auto section_c = recentred(detail::s1002_section_c, 0.0L, -30.5L, 4.5L);
  constexpr auto closing = recentred(detail::s1002_closing_cubic, -35.0L, -30.5L, 4.5L);
  auto c = section_c;
  if (form == S1002Form::closed) {
    for (std::size_t k = 0; k < c.size(); ++k) c[k] += closing[k];
  }
  const auto m = [](long double millimetres) { return constant<T>(millimetres * mm); };
  const T gh = m(-62.764705882L), fg = m(-49.662510381L), ef = m(-39.764473993L),
          de = m(-38.426669071L), cd = m(-35.0L), bc = m(-26.0L), ab = m(32.15796L);
  std::vector<Piece> pieces;
  pieces.reserve(8);
  pieces.push_back(Piece::arc(m(-69.999L), gh, m(-49.5L), m(9.519259302L), m(20.5L), true));
  pieces.push_back(Piece::arc(gh, fg, m(-55.0L), m(16.0L), m(12.0L), true));
  pieces.push_back(Piece::arc(fg, ef, m(-58.558326413L), m(8.83492413L), m(20.0L), true));
  pieces.push_back(Piece::line(ef, de, T(0), m(-93.576667419L), constant<T>(-2.747477419L)));
  pieces.push_back(Piece::arc(de, cd, m(-26.210665L), m(16.446L), m(13.0L), false));
  pieces.push_back(detail::s1002_polynomial<T>(cd, bc, -30.5L, 4.5L, c));
  pieces.push_back(detail::s1002_polynomial<T>(bc, ab, 3.07898L, 29.07898L, section_b));
  pieces.push_back(Piece::line(ab, m(60.0L), T(0), m(1.36432364L), constant<T>(-0.066666667L)));
  return PiecewiseProfile<T>(std::move(pieces));
}

}  // namespace wheelrail
