#pragma once
/// @file
/// Documentation only: frames, axes, signs and units, said once.
///
/// Units: SI throughout: m, rad, N, kg, s, Pa; curvature and spin creepage in 1/m. Files and
/// printed tables may use mm and say so.
///
/// Frames. A vector's name ends in the frame of its components. All are right-handed.
///
/// | frame | origin | x | y | z |
/// |---|---|---|---|---|
/// | track | midway between the rails, level with the heads' highest points | forward | left | up |
/// | rail  | the rail profile's origin | y x z: along the rail, forward on the left, backward on
/// the right | the profile's lateral axis, to the field side | up, leaning with the rail | | wheel
/// | the wheel profile's origin, on the axle | y x z | along the axle, to the field side | up | |
/// contact | the contact point | forward, along the strip | left, in the contact plane | from the
/// rail into the wheel | | body, world | dynamics/ only: a body's principal axes; inertial axes,
/// for a tangent track the track's | | | |
///
/// Lateral profile coordinates grow to the field side on both wheels and both rails. A wheel's
/// profile value F adds to the nominal radius; a rail's is the height. Both point out of the body.
///
/// Wheelset: the axle points along Rz(yaw) Rx(roll) e_y. Yaw is positive to the left, roll lifts
/// the left wheel, the lateral shift is positive to the left. Rolling forwards is an angular
/// velocity about +y. The two profile origins lie on the axle, profile_spacing apart.
///
/// Gauge: the distance of the inner faces 14 mm below the heads' highest points. Inclination: the
/// slope by which a rail's profile is turned about its origin towards the middle of the track.
///
/// Signs: penetration is positive in contact and its velocity positive while it grows. Curvature is
/// positive where a body is convex. Contact angle: slope of the contact plane against the track
/// plane, rising to the field side, so positive on the flanges of both wheels. Wheel angle:
/// right-handed about the axle's direction to the field side, zero in the plane through the axle
/// that is upright in the rail's cross-section.
/// Creepages are those of the wheel against the rail; forces are those on the wheel.
///
/// Symbols:
///
/// | name | paper | CONTACT | EN 15302 |
/// |---|---|---|---|
/// | wheel_lateral | u_w | -y_w left, y_w right wheel | y outboard |
/// | rail_lateral | u_r | -y_r left, y_r right rail | y (rail A: negative to the gauge) |
/// | wheel_angle | s_w | | |
/// | longitudinal | Delta x | x_cp | |
/// | penetration | delta | approach | |
/// | contact_angle | gamma_r plus the inclination | delta (its z points down) | |
/// | rolling_radius | R0 + F = -f_w | r0 + z_w | r |
/// | nominal_radius | R0 | r0 | r0 |
/// | rolling_radius_difference (left less right) | | | -Delta r (right less left) |
/// | creepage.longitudinal, .lateral, .spin | xi_x, xi_y, phi | cksi, ceta, cphi (y right, z down)
/// | | | HertzEllipse a, b | a, b | aa, bb | | | conicity | | | tan gamma_e |
