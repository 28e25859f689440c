#include "wheelset_contact.hpp"

#include <stdexcept>
#include <string>
#include <wheelrail/wheelrail.hpp>

namespace examples {

// Constructed once, which checks the data, and only read from then on.
struct WheelsetContact::Parts {
  wheelrail::Wheelset<wheelrail::PiecewiseProfile<double>> wheelset{
      wheelrail::s1002<double>(), 0.43, 1.5};  // nominal radius, profile spacing [m]
  wheelrail::TangentTrack<wheelrail::RailHead<double>> track{wheelrail::uic50<double>()};
  wheelrail::ContactForceModel<double> model;
};

struct WheelsetContact::Memory {
  wheelrail::WarmStripSearch<double> search;
};

WheelsetContact::WheelsetContact()
    : parts_(std::make_shared<const Parts>()),
      // Forces need each zone's deepest point, not where it ends.
      memory_(std::make_unique<Memory>(Memory{wheelrail::WarmStripSearch<double>(
          parts_->wheelset, wheelrail::SearchOptions<double>{.zone_ends = false})})) {}

WheelsetContact::~WheelsetContact() = default;
WheelsetContact::WheelsetContact(WheelsetContact&&) noexcept = default;
WheelsetContact& WheelsetContact::operator=(WheelsetContact&&) noexcept = default;

WheelsetContact::WheelsetContact(const WheelsetContact& other)
    : parts_(other.parts_), memory_(std::make_unique<Memory>(*other.memory_)) {}

WheelsetContact& WheelsetContact::operator=(const WheelsetContact& other) {
  return *this = WheelsetContact(other);
}

ContactWrench WheelsetContact::wrench(const WheelsetState& state) {
  const wheelrail::WheelsetPosition<double> at{state.centre_track, state.axle_track};
  const wheelrail::WheelsetMotion<double> motion{state.velocity_track,
                                                 state.angular_velocity_track};
  const auto forces =
      wheelset_forces(parts_->wheelset, parts_->track, at, motion, parts_->model, memory_->search);
  for (const auto& wheel : forces.wheels) {
    if (wheel.status != wheelrail::SearchStatus::complete) {
      throw std::runtime_error(
          std::string("the contact search failed: ").append(name_of(wheel.status)));
    }
  }
  return {forces.force_track, forces.moment_track};
}

}  // namespace examples
