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

/// @namespace wheelrail
/// All of the library; the folders of the headers carry the structure.

/// @mainpage From the paper's sections to the headers
///
/// Where wheels touch rails, with what patches, and with what forces; for profiles with concave
/// fillets too. Sections and equations are those of F. Marques, H. Magalhães, J. Pombo,
/// J. Ambrósio, P. Flores, A three-dimensional approach for contact detection between realistic
/// wheel and rail surfaces for improved railway dynamic analysis, Mechanism and Machine Theory 149 (2020)
/// 103825; where it has errata, the header says what was mended.
///
/// - All frames, axes, signs and units, and the symbols of the paper: @ref conventions.hpp
/// - One include for nearly all: @ref wheelrail.hpp
/// - What a simulator calls at every evaluation of its equations of motion:
///   @ref wheelrail::wheelset_forces "wheelset_forces"; for the patches of one wheel alone
///   @ref wheelrail::find_contact "find_contact"; for the forces of patches that another search
///   found @ref wheelrail::ContactForceModel "ContactForceModel"
/// - What an own profile has to offer: the concept @ref wheelrail::Profile "Profile"
///
/// @section paper_2_1 §2.1 Wheel and rail surfaces, (1)-(27)
/// - The wheel turned about its axle, the rail swept along its track, with tangents, normals and
///   curvatures: @ref surface/wheel.hpp, @ref surface/rail.hpp
/// - The track that the rails lie on: straight @ref track/tangent_track.hpp, of any layout
///   @ref track/nodal_track.hpp, with its centre line @ref track/centre_line.hpp and
///   irregularities @ref track/irregularities.hpp
///
/// @section paper_2_2 §2.2 Profiles
/// - Value, slope and second derivative in one call (14): @ref profile/profile.hpp, and polynomials
///   and arcs as standards have them: @ref profile/piecewise_profile.hpp
/// - The wheel S1002: @ref profile/s1002.hpp; rail heads: @ref profile/rail_head.hpp
/// - The simplified, convex wheel: @ref profile/convex_modification.hpp; joints and concave zones:
///   @ref profile/inspection.hpp
/// - Measured points, which the paper has not: @ref io/profile_file.hpp,
///   @ref profile/profile_points.hpp, @ref profile/noise_estimate.hpp,
///   @ref profile/spline_profile.hpp
///
/// @section paper_3_1 §3.1 Minimum distance method, (28)-(33)
/// - On each convex part of the wheel: @ref contact/minimum_distance.hpp
///
/// @section paper_3_2 §3.2 Search for all contacts, (34)-(62)
/// - Both wheels on their axle (35): @ref wheelset/wheelset.hpp; a wheel over its rail (34)-(51):
///   @ref contact/placement.hpp
/// - The contact locus, wheel angle and longitudinal offset (52)-(60): @ref contact/locus.hpp
/// - The foot on the rail (61): @ref contact/rail_foot.hpp
/// - All patches (62), with a proof that none is missing: @ref contact/find_contact.hpp; what it
///   returns: @ref contact/patch.hpp; with a warm start: @ref contact/search_memory.hpp; for many
///   placements: @ref contact/find_contact_batch.hpp
///
/// @section paper_4_1 §4.1 Normal contact forces, (63)-(70)
/// - Hertz's ellipse and stiffness, also of (75)-(77): @ref force/hertz.hpp with
///   @ref force/material.hpp
/// - The normal force with its damping: @ref force/normal_force.hpp
///
/// @section paper_4_2 §4.2 Creep forces, (71)-(90)
/// - Creepages: @ref force/creepage.hpp; Kalker's coefficients: @ref force/kalker.hpp; Polach's
///   forces: @ref force/polach.hpp
/// - All of §4 for one contact: @ref force/contact_force.hpp, its slopes:
///   @ref force/contact_force_jacobian.hpp
/// - Both wheels, their forces and the wrench on the wheelset: @ref wheelset/wheelset_forces.hpp
///
/// @section paper_5 §5 Multibody dynamics, (91)-(94)
/// - Bodies @ref dynamics/rigid_body.hpp, joints @ref dynamics/revolute_joint.hpp, springs and
///   dampers @ref dynamics/spring_damper.hpp, the system @ref dynamics/multibody_system.hpp
/// - The integrator of Table 2: @ref numerics/dormand_prince.hpp
/// - States of rest and small motions, which the paper has not:
///   @ref dynamics/static_equilibrium.hpp, @ref dynamics/linearize.hpp
///
/// @section paper_none What the paper has not
/// - A wheelset set down on its track: @ref wheelset/touching_position.hpp; rolling radius
///   difference and contact points over lateral shifts: @ref wheelset/kinematics_table.hpp;
///   equivalent conicity: @ref wheelset/equivalent_conicity.hpp
/// - A lookup table of the contact with its measured error: @ref wheelset/contact_lookup.hpp
/// - Derivatives of everything by dual numbers: @ref core/dual.hpp, or others that
///   @ref core/scalar_value.hpp knows; roots get theirs in @ref numerics/lifted_root.hpp. Without dual
///   numbers: @ref force/creep_jacobian.hpp, @ref wheelset/contact_linearization.hpp
/// - A wrench that does not jump: @ref contact/patch_blending.hpp
/// - Largest stable steps: @ref numerics/explicit_method.hpp, @ref dynamics/stable_step.hpp
/// - The version: @ref version.hpp
