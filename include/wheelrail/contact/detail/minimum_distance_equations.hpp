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
    Vector3<T> distance_rail;     // d of (29)
    Vector3<T> rail_normal_rail;  // n_r
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

    const Vector3<T> rail_normal_rail = Rail<R>::normal_rail(on_rail);
    const Vector3<T> rail_lateral_tangent_rail = Rail<R>::lateral_tangent_rail(on_rail);
    const Vector3<T> along_rail = Vector3<T>::UnitX();
    const Vector3<T> wheel_normal_rail = turned(Wheel<P>::normal_wheel(on_wheel, angle));
    const Vector3<T> wheel_lateral_tangent_rail =
        turned(Wheel<P>::lateral_tangent_wheel(on_wheel, angle));
    const Vector3<T> wheel_longitudinal_tangent_rail =
        turned(Wheel<P>::longitudinal_tangent_wheel(angle));
    const Vector3<T> wheel_point_rail =
        placement_.position_rail + turned(wheel_.position_wheel(u_w, on_wheel, angle));
    const Vector3<T> distance_rail = wheel_point_rail - Rail<R>::position_rail(x(0), u_r, on_rail);

    // Derivatives of the distance vector by the four unknowns.
    const Vector3<T> distance_by_rail[4] = {-along_rail, -rail_length * rail_lateral_tangent_rail,
                                            -radius * wheel_longitudinal_tangent_rail,
                                            wheel_length * wheel_lateral_tangent_rail};
    // Derivatives of the wheel's tangents and normal by the wheel angle; those by wheel_lateral are
    // multiples of its normal and lateral tangent.
    const T sine_gamma = -on_wheel.slope / wheel_length;
    const T cosine_gamma = T(1) / wheel_length;
    const Vector3<T> longitudinal_tangent_by_angle_rail =
        turned(Vector3<T>(-angle.sine, T(0), -angle.cosine));
    const Vector3<T> lateral_tangent_by_angle_rail = sine_gamma * wheel_longitudinal_tangent_rail;
    const Vector3<T> normal_by_angle_rail = -cosine_gamma * wheel_longitudinal_tangent_rail;

    Evaluation at;
    at.distance_rail = distance_rail;
    at.rail_normal_rail = rail_normal_rail;
    Matrix& j = at.jacobian;
    if (form_ == MinimumDistanceForm::wheel_normal) {
      at.residual << distance_rail.dot(wheel_lateral_tangent_rail),
          distance_rail.dot(wheel_longitudinal_tangent_rail),
          rail_normal_rail.dot(wheel_lateral_tangent_rail),
          rail_normal_rail.dot(wheel_longitudinal_tangent_rail);
      for (int k = 0; k < 4; ++k) {
        j(0, k) = distance_by_rail[k].dot(wheel_lateral_tangent_rail);
        j(1, k) = distance_by_rail[k].dot(wheel_longitudinal_tangent_rail);
      }
      j(0, 2) += distance_rail.dot(lateral_tangent_by_angle_rail);
      j(1, 2) += distance_rail.dot(longitudinal_tangent_by_angle_rail);
      j(0, 3) -= wheel_turn * distance_rail.dot(wheel_normal_rail);
      j(2, 0) = j(3, 0) = T(0);
      j(2, 1) = -rail_turn * rail_lateral_tangent_rail.dot(wheel_lateral_tangent_rail);
      j(3, 1) = -rail_turn * rail_lateral_tangent_rail.dot(wheel_longitudinal_tangent_rail);
      j(2, 2) = rail_normal_rail.dot(lateral_tangent_by_angle_rail);
      j(3, 2) = rail_normal_rail.dot(longitudinal_tangent_by_angle_rail);
      j(2, 3) = -wheel_turn * rail_normal_rail.dot(wheel_normal_rail);
      j(3, 3) = T(0);
    } else {
      at.residual << distance_rail.dot(rail_lateral_tangent_rail), distance_rail.dot(along_rail),
          wheel_normal_rail.dot(rail_lateral_tangent_rail), wheel_normal_rail.dot(along_rail);
      for (int k = 0; k < 4; ++k) {
        j(0, k) = distance_by_rail[k].dot(rail_lateral_tangent_rail);
        j(1, k) = distance_by_rail[k].dot(along_rail);
      }
      j(0, 1) += rail_turn * distance_rail.dot(rail_normal_rail);
      j(2, 0) = j(3, 0) = T(0);
      j(2, 1) = rail_turn * wheel_normal_rail.dot(rail_normal_rail);
      j(3, 1) = T(0);
      j(2, 2) = normal_by_angle_rail.dot(rail_lateral_tangent_rail);
      j(3, 2) = normal_by_angle_rail.dot(along_rail);
      j(2, 3) = wheel_turn * wheel_lateral_tangent_rail.dot(rail_lateral_tangent_rail);
      j(3, 3) = wheel_turn * wheel_lateral_tangent_rail.dot(along_rail);
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
