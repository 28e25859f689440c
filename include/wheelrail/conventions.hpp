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
/// | track | midway between the rails, level with the heads' tops | forward | left | up |
/// | rail | the rail profile's origin | y x z, along the rail | to the field side | up |
/// | wheel | the wheel profile's origin, on the axle | y x z | outwards along the axle | up |
/// | contact | the contact point | forward | left, in the contact plane | from rail into wheel |
/// | body (dynamics/) | the centre of mass | principal axis | principal axis | principal axis |
/// | world (dynamics/) | inertial; on a tangent track the track frame | | | |
///
/// The rail frame's y is the profile's lateral axis and its z leans with the rail; x points forward
/// on the left and backward on the right, as does the wheel frame's. The contact frame's x lies
/// along the strip of the wheel.
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
/// Curved track: heading, curvature and turn are positive to the left. Cant is the height of the right
/// rail over the left, positive where the track leans into a left curve; the track plane turns about
/// the centre line, which stays at z = 0. The arc length of both rails is that of the centre line. The
/// track frame is that of the start of the centre line; inclination stays against the canted plane.
///
/// Signs: penetration is positive in contact and its velocity positive while it grows. Curvature is
/// positive where a body is convex. Contact angle: slope of the contact plane against the track
/// plane, rising to the field side, so positive on the flanges of both wheels. Wheel angle:
/// right-handed about the axle's direction to the field side, zero in the plane through the axle
/// that is upright in the rail's cross-section. Creepages are those of the wheel against the rail;
/// forces are those on the wheel.
///
/// Depth: a contact search needs penetrations smaller than the rail's corner radius (13 mm). Deeper
/// down the nearest point of the rail, which penetration is measured to, is no longer unique.
///
/// Symbols. "coming" names are kept for what is not in the library yet.
///
/// | name | paper | CONTACT | EN 15302 |
/// |---|---|---|---|
/// | wheel_lateral | u_w | -y_w left, y_w right wheel | y outboard |
/// | rail_lateral | u_r | -y_r left, y_r right rail (1) | y (rail A: negative to the gauge) |
/// | wheel_angle | s_w | | |
/// | longitudinal | Delta x | x_cp | |
/// | penetration | delta | approach | |
/// | contact_angle | gamma_r plus the inclination | delta (its z points down) | |
/// | rolling_radius | R0 + F = -f_w | r0 + z_w | r |
/// | nominal_radius | R0 | r0 | r0 |
/// | creepage.longitudinal, .lateral, .spin | xi_x, xi_y, phi | cksi, ceta, cphi (2) | |
/// | HertzEllipse a, b | a, b | aa, bb | |
/// | rolling_radius_difference, left less right | | | -Delta r (right less left) |
/// | lateral_shift, to the left | | -Y_ws | -y (to the right) |
/// | conicity | | | tan gamma_e |
///
/// (1) Up to origin and inclination: CONTACT counts y_r level with the track, from the highest
/// point of the inclined head; rail_lateral runs along the profile's own axis from its origin.
/// (2) With y to the right and z down.
