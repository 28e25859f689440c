#pragma once
/// @file
/// The equations of the minimum distance method, (28)-(31) of the paper, with their analytic
/// Jacobian. May include: core, numerics, profile, surface.

#include <wheelrail/contact/placement.hpp>

namespace wheelrail {

/// Which body's normal the distance vector is held parallel to.
enum class MinimumDistanceForm {
  wheel_normal,  ///< (30): d.t_w,u = d.t_w,s = n_r.t_w,u = n_r.t_w,s = 0
  rail_normal    ///< (31): d.t_r,u = d.t_r,s = n_w.t_r,u = n_w.t_r,s = 0
};

namespace detail {

/// The equations of the method at one placement, with their analytic Jacobian.
///
/// All vectors are taken apart along the wheel's strip: its longitudinal tangent t_w,s (20), the
/// axle and the radius outwards. There the wheel's own vectors are short, t_w,u = cos(gamma)
/// (0, 1, F') and n_w = cos(gamma) (0, -F', 1), and turning by s_w only swaps two components.
template <Profile P, Profile R>
class MinimumDistanceEquations {
 public:
  using T = typename P::Scalar;
  using Vector = Vector4<T>;  // (s_r, u_r, s_w, u_w)
  using Matrix = Eigen::Matrix<T, 4, 4, Eigen::DontAlign>;

  MinimumDistanceEquations(const Wheel<P>& wheel, const Rail<R>& rail,
                           const WheelPlacement<T>& placement, MinimumDistanceForm form)
      : wheel_(wheel),
        rail_(rail),
        placement_(placement),
        form_(form),
        inverse_radius_(T(1) / wheel.nominal_radius()) {}

  struct Evaluation {
    Vector residual;  // two lengths [m], two cosines [-]
    Matrix jacobian;
  };

  /// Two points and what their residuals and the Jacobian are made of.
  struct Pair {
    ProfilePoint<T> on_wheel, on_rail;
    T radius = T(0);        // of the wheel's point [m]
    T wheel_cosine = T(0);  // of gamma, the wheel profile's own slope angle
    T rail_length = T(0);   // sqrt(1 + f'^2)
    Vector3<T> distance;    // d of (29) and the rail's vectors, all along the strip
    Vector3<T> along_rail, rail_tangent, rail_normal;
    Vector residual;
    T norm = T(0);         // of the residual: the larger of |d.t| / nominal radius and |n.t| [-]
    T penetration = T(0);  // -n_r.d [m]
  };

  /// Residuals without the Jacobian.
  [[nodiscard]] Pair pair(const Vector& x) const {
    using std::sqrt;
    Pair at;
    const T u_r = clamp(x(1), rail_.profile().lower(), rail_.profile().upper());
    const T u_w = clamp(x(3), wheel_.profile().lower(), wheel_.profile().upper());
    at.on_rail = rail_.profile().evaluate(u_r);
    at.on_wheel = wheel_.profile().evaluate(u_w);
    const WheelAngle<T> angle = WheelAngle<T>::of(x(2));
    const T rail_slope = at.on_rail.slope, wheel_slope = at.on_wheel.slope;
    at.radius = wheel_.radius(at.on_wheel);
    at.rail_length = sqrt(T(T(1) + rail_slope * rail_slope));
    at.wheel_cosine = T(1) / T(sqrt(T(T(1) + wheel_slope * wheel_slope)));

    const Vector3<T>& origin_rail = placement_.position_rail;
    const T& s = placement_.sin_yaw;
    const T& c = placement_.cos_yaw;
    at.along_rail = along_strip(c, T(-s), T(0), angle);
    const auto in_section = [&](const T& y, const T& z) {
      const T level = placement_.cos_roll * y + placement_.sin_roll * z;
      const T upright = placement_.cos_roll * z - placement_.sin_roll * y;
      return along_strip(T(s * level), T(c * level), upright, angle);
    };
    const T rail_cosine = T(1) / at.rail_length;
    at.rail_tangent = in_section(rail_cosine, T(rail_slope * rail_cosine));
    at.rail_normal = in_section(T(-rail_slope * rail_cosine), rail_cosine);
    at.distance = in_section(T(origin_rail.y() - u_r), T(origin_rail.z() - at.on_rail.value));
    at.distance += (origin_rail.x() - x(0)) * at.along_rail;
    at.distance += Vector3<T>(T(0), u_w, at.radius);

    if (form_ == MinimumDistanceForm::wheel_normal) {
      at.residual = Vector(by_wheel_tangent(at, at.distance), at.distance.x(),
                           by_wheel_tangent(at, at.rail_normal), at.rail_normal.x());
    } else {
      at.residual =
          Vector(dot(at.distance, at.rail_tangent), dot(at.distance, at.along_rail),
                 by_wheel_normal(at, at.rail_tangent), by_wheel_normal(at, at.along_rail));
    }
    at.norm = max(max(magnitude(at.residual(0)), magnitude(at.residual(1))) * inverse_radius_,
                  max(magnitude(at.residual(2)), magnitude(at.residual(3))));
    at.penetration = -dot(at.rail_normal, at.distance);
    return at;
  }

  /// The derivatives of the residuals by (s_r, u_r, s_w, u_w). Those of d are -x, -(1 + f'^2)^(1/2)
  /// t_r,u, -R t_w,s and (1 + F'^2)^(1/2) t_w,u.
  [[nodiscard]] Matrix jacobian(const Pair& at) const {
    const T& wheel_slope = at.on_wheel.slope;
    // Turning rates of the profiles' tangents: d gamma / du. The wheel's (23) is -arctan F'.
    const T rail_turn = at.on_rail.second_derivative / (at.rail_length * at.rail_length);
    const T wheel_turn = -at.on_wheel.second_derivative * at.wheel_cosine * at.wheel_cosine;
    const T wheel_length = at.wheel_cosine * (T(1) + wheel_slope * wheel_slope);
    const T along_wheel_tangent = by_wheel_tangent(at, at.along_rail);
    const T tangents = by_wheel_tangent(at, at.rail_tangent);
    Matrix j;
    j(2, 0) = j(3, 0) = T(0);
    if (form_ == MinimumDistanceForm::wheel_normal) {
      const T wheel_sine = -wheel_slope * at.wheel_cosine;
      j(0, 0) = -along_wheel_tangent;
      j(1, 0) = -at.along_rail.x();
      j(0, 1) = -at.rail_length * tangents;
      j(1, 1) = -at.rail_length * at.rail_tangent.x();
      j(2, 1) = -rail_turn * tangents;
      j(3, 1) = -rail_turn * at.rail_tangent.x();
      j(0, 2) = wheel_sine * at.distance.x();
      j(1, 2) = at.distance.z() - at.radius;
      j(2, 2) = wheel_sine * at.rail_normal.x();
      j(3, 2) = at.rail_normal.z();
      j(0, 3) = wheel_length - wheel_turn * by_wheel_normal(at, at.distance);
      j(2, 3) = -wheel_turn * by_wheel_normal(at, at.rail_normal);
      j(1, 3) = j(3, 3) = T(0);
    } else {
      j(1, 0) = T(-1);
      j(0, 1) = -at.rail_length - rail_turn * at.penetration;
      j(2, 1) = rail_turn * by_wheel_normal(at, at.rail_normal);
      j(0, 2) = -at.radius * at.rail_tangent.x();
      j(1, 2) = -at.radius * at.along_rail.x();
      j(2, 2) = -at.wheel_cosine * at.rail_tangent.x();
      j(3, 2) = -at.wheel_cosine * at.along_rail.x();
      j(0, 3) = wheel_length * tangents;
      j(1, 3) = wheel_length * along_wheel_tangent;
      j(2, 3) = wheel_turn * tangents;
      j(3, 3) = wheel_turn * along_wheel_tangent;
      j(0, 0) = j(1, 1) = j(3, 1) = T(0);
    }
    return j;
  }

  /// Newton's step, -J^-1 r. Row 1 is solved for s_r, which no cosine depends on, row 3 for s_w:
  /// its pivot is near -1, as wheel and rail are not far from lying across. Left are two equations
  /// for u_r and u_w. Not finite where J is singular.
  [[nodiscard]] Vector newton_step(const Pair& at) const {
    const Matrix j = jacobian(at);
    const Vector& r = at.residual;
    const T by_s_r = j(0, 0) / j(1, 0);
    const T r0 = r(0) - by_s_r * r(1), j02 = j(0, 2) - by_s_r * j(1, 2);
    const T inverse_s_w = T(1) / j(3, 2);
    const T row0 = j02 * inverse_s_w, row2 = j(2, 2) * inverse_s_w;
    const T a00 = j(0, 1) - by_s_r * j(1, 1) - row0 * j(3, 1);
    const T a01 = j(0, 3) - by_s_r * j(1, 3) - row0 * j(3, 3);
    const T a10 = j(2, 1) - row2 * j(3, 1), a11 = j(2, 3) - row2 * j(3, 3);
    const T b0 = r0 - row0 * r(3), b1 = r(2) - row2 * r(3);
    const T inverse_determinant = T(1) / (a00 * a11 - a01 * a10);
    const T u_r = (a01 * b1 - a11 * b0) * inverse_determinant;
    const T u_w = (a10 * b0 - a00 * b1) * inverse_determinant;
    const T s_w = -(r(3) + j(3, 1) * u_r + j(3, 3) * u_w) * inverse_s_w;
    const T s_r = -(r(1) + j(1, 1) * u_r + j(1, 2) * s_w + j(1, 3) * u_w) / j(1, 0);
    return Vector(s_r, u_r, s_w, u_w);
  }

  /// Residuals and Jacobian.
  [[nodiscard]] Evaluation operator()(const Vector& x) const {
    const Pair at = pair(x);
    return {at.residual, jacobian(at)};
  }

 private:
  // (x, y, z) of the wheel frame along its strip at `angle`.
  [[nodiscard]] static Vector3<T> along_strip(const T& x, const T& y, const T& z,
                                              const WheelAngle<T>& angle) {
    return Vector3<T>(angle.cosine * x - angle.sine * z, y, -angle.sine * x - angle.cosine * z);
  }
  // v.t_w,u and v.n_w of a vector along the strip.
  [[nodiscard]] static T by_wheel_tangent(const Pair& at, const Vector3<T>& v) {
    return at.wheel_cosine * (v.y() + at.on_wheel.slope * v.z());
  }
  [[nodiscard]] static T by_wheel_normal(const Pair& at, const Vector3<T>& v) {
    return at.wheel_cosine * (v.z() - at.on_wheel.slope * v.y());
  }

  const Wheel<P>& wheel_;
  const Rail<R>& rail_;
  const WheelPlacement<T>& placement_;
  MinimumDistanceForm form_;
  T inverse_radius_;
};

}  // namespace detail
}  // namespace wheelrail
