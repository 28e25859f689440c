#pragma once
/// @file
/// All of wheelrail but the rigid bodies (dynamics/), files (io/), the integrator of numerics/ and
/// wheelset/contact_linearization.hpp, which needs Eigen's eigenvalues.
/// Frames, axes, signs and units are in conventions.hpp.

#include <wheelrail/contact/find_contact_batch.hpp>
#include <wheelrail/contact/minimum_distance.hpp>
#include <wheelrail/conventions.hpp>
#include <wheelrail/core/dual.hpp>
#include <wheelrail/force/contact_force.hpp>
#include <wheelrail/force/contact_force_jacobian.hpp>
#include <wheelrail/profile/convex_modification.hpp>
#include <wheelrail/profile/inspection.hpp>
#include <wheelrail/profile/noise_estimate.hpp>
#include <wheelrail/profile/profile_points.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/profile/spline_profile.hpp>
#include <wheelrail/track/centre_line.hpp>
#include <wheelrail/track/irregularities.hpp>
#include <wheelrail/track/nodal_track.hpp>
#include <wheelrail/track/tangent_track.hpp>
#include <wheelrail/version.hpp>
#include <wheelrail/wheelset/contact_lookup.hpp>
#include <wheelrail/wheelset/contact_lookup_report.hpp>
#include <wheelrail/wheelset/equivalent_conicity.hpp>
#include <wheelrail/wheelset/fit.hpp>
#include <wheelrail/wheelset/kinematics.hpp>
#include <wheelrail/wheelset/kinematics_table.hpp>
#include <wheelrail/wheelset/lookup_axis.hpp>
#include <wheelrail/wheelset/search_method.hpp>
#include <wheelrail/wheelset/touching_position.hpp>
#include <wheelrail/wheelset/wheelset.hpp>
#include <wheelrail/wheelset/wheelset_forces.hpp>
