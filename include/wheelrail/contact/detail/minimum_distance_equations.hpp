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
template <Profile P, Profile R>
class MinimumDistanceEquations {
 public:
  using T = typename P::Scalar;
  using Vector = Vector4<T>;  // (s_r, u_r, s_w, u_w)
  using Matrix = Eigen::Matrix<T, 4, 4, Eigen::DontAlign>;

  MinimumDistanceEquations(const Wheel<P>& wheel, const Rail<R>& rail,
                           const WheelPlacement<T>& placement, MinimumDistanceForm form)
      : wheel_(wheel), rail_(rail), placement_(placement), form_(form) {}

  struct Evaluation {
    Vector residual;  // two lengths [m], two cosines [-]
    Matrix jacobian;
    Vector3<T> distance_rail;  // d of (29)
    Vector3<T> normal_rail;    // n_r
  };

  [[nodiscard]] Evaluation operator()(const Vector& x) const {
    using std::sqrt;
    const T u_r = clamp(x(1), rail_.profile().lower(), rail_.profile().upper());
    const T u_w = clamp(x(3), wheel_.profile().lower(), wheel_.profile().upper());
    const ProfilePoint<T> on_rail = rail_.profile().evaluate(u_r);
    const ProfilePoint<T> on_wheel = wheel_.profile().evaluate(u_w);
    const WheelAngle<T> angle = WheelAngle<T>::of(x(2));
    const auto turned = [this](const Vector3<T>& v) { return placement_.direction_rail(v); };

    const T rail_length = sqrt(T(T(1) + on_rail.slope * on_rail.slope));
    const T wheel_length = sqrt(T(T(1) + on_wheel.slope * on_wheel.slope));
    // Turning rates of the profiles' tangents: d gamma / du. The wheel's (23) is -arctan F'.
    const T rail_turn = on_rail.second_derivative / (rail_length * rail_length);
    const T wheel_turn = -on_wheel.second_derivative / (wheel_length * wheel_length);
    const T radius = wheel_.radius(on_wheel);

    const Vector3<T> n_r = Rail<R>::normal_rail(on_rail);
    const Vector3<T> t_ru = Rail<R>::lateral_tangent_rail(on_rail);
    const Vector3<T> t_rs = Vector3<T>::UnitX();
    const Vector3<T> n_w = turned(Wheel<P>::normal_wheel(on_wheel, angle));
    const Vector3<T> t_wu = turned(Wheel<P>::lateral_tangent_wheel(on_wheel, angle));
    const Vector3<T> t_ws = turned(Wheel<P>::longitudinal_tangent_wheel(angle));
    const Vector3<T> q =
        placement_.position_rail + turned(wheel_.position_wheel(u_w, on_wheel, angle));
    const Vector3<T> d = q - Rail<R>::position_rail(x(0), u_r, on_rail);

    // Derivatives of d by the four unknowns.
    const Vector3<T> d_by[4] = {-t_rs, -rail_length * t_ru, -radius * t_ws, wheel_length * t_wu};
    // Derivatives of the wheel's tangents and normal by s_w; those by u_w are multiples of n_w,
    // t_wu.
    const T sine_gamma = -on_wheel.slope / wheel_length;
    const T cosine_gamma = T(1) / wheel_length;
    const Vector3<T> t_ws_by_angle = turned(Vector3<T>(-angle.sine, T(0), -angle.cosine));
    const Vector3<T> t_wu_by_angle = sine_gamma * t_ws;
    const Vector3<T> n_w_by_angle = -cosine_gamma * t_ws;

    Evaluation at;
    at.distance_rail = d;
    at.normal_rail = n_r;
    Matrix& j = at.jacobian;
    if (form_ == MinimumDistanceForm::wheel_normal) {
      at.residual << d.dot(t_wu), d.dot(t_ws), n_r.dot(t_wu), n_r.dot(t_ws);
      for (int k = 0; k < 4; ++k) {
        j(0, k) = d_by[k].dot(t_wu);
        j(1, k) = d_by[k].dot(t_ws);
      }
      j(0, 2) += d.dot(t_wu_by_angle);
      j(1, 2) += d.dot(t_ws_by_angle);
      j(0, 3) -= wheel_turn * d.dot(n_w);
      j(2, 0) = j(3, 0) = T(0);
      j(2, 1) = -rail_turn * t_ru.dot(t_wu);
      j(3, 1) = -rail_turn * t_ru.dot(t_ws);
      j(2, 2) = n_r.dot(t_wu_by_angle);
      j(3, 2) = n_r.dot(t_ws_by_angle);
      j(2, 3) = -wheel_turn * n_r.dot(n_w);
      j(3, 3) = T(0);
    } else {
      at.residual << d.dot(t_ru), d.dot(t_rs), n_w.dot(t_ru), n_w.dot(t_rs);
      for (int k = 0; k < 4; ++k) {
        j(0, k) = d_by[k].dot(t_ru);
        j(1, k) = d_by[k].dot(t_rs);
      }
      j(0, 1) += rail_turn * d.dot(n_r);
      j(2, 0) = j(3, 0) = T(0);
      j(2, 1) = rail_turn * n_w.dot(n_r);
      j(3, 1) = T(0);
      j(2, 2) = n_w_by_angle.dot(t_ru);
      j(3, 2) = n_w_by_angle.dot(t_rs);
      j(2, 3) = wheel_turn * t_wu.dot(t_ru);
      j(3, 3) = wheel_turn * t_wu.dot(t_rs);
    }
    return at;
  }

  /// The larger of |d.t| / nominal radius and |n.t| [-].
  [[nodiscard]] T norm(const Vector& residual) const {
    const T scale = wheel_.nominal_radius();
    return max(max(T(magnitude(residual(0)) / scale), T(magnitude(residual(1)) / scale)),
               max(magnitude(residual(2)), magnitude(residual(3))));
  }

 private:
  const Wheel<P>& wheel_;
  const Rail<R>& rail_;
  const WheelPlacement<T>& placement_;
  MinimumDistanceForm form_;
};

}  // namespace detail
}  // namespace wheelrail
