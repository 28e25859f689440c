#pragma once
// The search of find_contact.hpp for a block of placements, stage by stage instead of one placement
// after the other, so that what a stage evaluates fills lanes: near runs; the strips at the ends of
// parts, and of those that a part of which nothing is known is divided into; extrema; the zones' ends;
// patches. What is decided, and by what bounds, is the same as there. A placement that needs more than
// this, where nothing is known between two neighbouring strips or an iteration is long, is left to the
// search of one. May include: core, numerics, profile, surface, contact.

#include <span>
#include <vector>
#include <wheelrail/contact/detail/first_guess_lanes.hpp>
#include <wheelrail/contact/detail/judge_lanes.hpp>
#include <wheelrail/contact/detail/near_run_lanes.hpp>
#include <wheelrail/contact/detail/near_runs.hpp>
#include <wheelrail/contact/find_contact.hpp>

namespace wheelrail::detail {

template <Profile P, Profile R>
class BlockWalk {
 public:
  using T = typename P::Scalar;
  // So many placements make full lanes, and what is known of them stays in a cache.
  static constexpr std::size_t greatest_size = 64;

  BlockWalk(const Wheel<P>& wheel, const Rail<R>& rail, const PlacementBatch<T>& placements,
            const SearchOptions<T>& options)
      : wheel_(wheel),
        rail_(rail),
        placements_(placements),
        options_(options),
        margin_(T(64) * epsilon<T>() * wheel.nominal_radius()),
        bounds_(rail, wheel.strips().greatest_radius(), T(options.penetration_threshold - margin_)),
        newton_(wheel) {
    items_.reserve(greatest_size);
    strips_.reserve(8 * greatest_size);
    parts_.reserve(8 * greatest_size);
    extrema_.reserve(4 * greatest_size);
    zones_.reserve(4 * greatest_size);
    ends_.reserve(8 * greatest_size);
  }

  // Searches the placements of these indices; results[i] becomes that of placement i.
  void run(std::span<const std::size_t> indices, std::span<ContactResult<T>> results) {
    items_.clear();
    strips_.clear();
    parts_.clear();
    extrema_.clear();
    zones_.clear();
    ends_.clear();
    for (const std::size_t index : indices) items_.push_back({index, {placements_, index}});
    find_near_runs();
    judge_parts();
    for (const Part& part : parts_) ask_for_extremum(part);
    solve_extrema();
    for (std::size_t i = 0; i < items_.size(); ++i) walk(i);
    solve_ends();
    report(results);
  }

 private:
  using Judged = LocusStrip<T>;
  static constexpr int none = -1;

  // A placement.
  struct Item {
    std::size_t index;  // in the batch
    SectionPlacement<T> placement;
    int first_run = none, last_run = none;  // parts
    int evaluations = 0;
    bool is_left = false;  // to the search of one
  };
  // A strip, and where it is from.
  struct StripOf {
    Judged strip;
    std::size_t item = 0;
    int index = none;  // among the wheel's
  };
  // What lies between two strips of one piece.
  struct Part {
    std::size_t item = 0;
    int first = 0, last = 0;          // the wheel's strips at its ends
    std::size_t left = 0, right = 0;  // the same, evaluated
    int next_run = none;              // of the placement, where this is a run
    int child = none;                 // the first of two that it is divided into
    int extremum = none;              // a strip
    Verdict verdict = Verdict::excluded;
  };
  struct Zone {
    std::size_t item = 0;
    std::size_t deepest = 0;
    T lower = T(0), upper = T(0);
    bool is_cut = false;
  };
  // Where a zone ends between two strips.
  struct ZoneEnd {
    std::size_t zone = 0, left = 0, right = 0;
    bool is_lower = false;
  };

  [[nodiscard]] static std::size_t at(int index) { return static_cast<std::size_t>(index); }
  // That of a lane among `count` things from `begin` on; the last one fills lanes that are left.
  [[nodiscard]] static std::size_t in_lane(std::size_t begin, int lane, std::size_t count) {
    const std::size_t i = begin + at(lane);
    return i < count ? i : count - 1;
  }
  [[nodiscard]] static int lanes_used(std::size_t begin, std::size_t count) {
    return count - begin < at(lane_count) ? static_cast<int>(count - begin) : lane_count;
  }

  [[nodiscard]] std::size_t add_strip(std::size_t item, int index) {
    strips_.push_back({Judged(), item, index});
    return strips_.size() - 1;
  }

  void find_near_runs() {
    PlacementLanes<T> placements;
    for (std::size_t begin = 0; begin < items_.size(); begin += lane_count) {
      const int used = lanes_used(begin, items_.size());
      for (int lane = 0; lane < lane_count; ++lane) {
        placements.set(lane, items_[in_lane(begin, lane, items_.size())].placement);
      }
      for_each_near_run(wheel_, rail_, placements, T(options_.penetration_threshold - margin_),
                        [&](int lane, int first, int last) {
                          if (lane < used) add_run(begin + at(lane), first, last);
                        });
    }
  }

  void add_run(std::size_t item, int first, int last) {
    const int run = static_cast<int>(parts_.size());
    Item& of = items_[item];
    if (of.first_run == none) of.first_run = run;
    if (of.last_run != none) parts_[at(of.last_run)].next_run = run;
    of.last_run = run;
    const std::size_t left = add_strip(item, first), right = add_strip(item, last);
    parts_.push_back({item, first, last, left, right});
  }

  // Judges all parts, those too that open ones are divided into.
  void judge_parts() {
    std::size_t evaluated = 0;
    for (std::size_t judged = 0; judged < parts_.size();) {
      evaluate_strips(evaluated);
      evaluated = strips_.size();
      const std::size_t end = parts_.size();
      for (; judged < end; judged = std::min(end, judged + lane_count)) judge(judged, end);
    }
  }

  // The parts of a lane each, from `begin` on, of those before `end`.
  void judge(std::size_t begin, std::size_t end) {
    PlacementLanes<T> placements;
    LocusStripLanes<T> left, right;
    ShapeBoundsLanes<T> shape;
    for (int lane = 0; lane < lane_count; ++lane) {
      const Part& part = parts_[in_lane(begin, lane, end)];
      placements.set(lane, items_[part.item].placement);
      left.set(lane, strips_[part.left].strip);
      right.set(lane, strips_[part.right].strip);
      shape.set(lane, wheel_.strips().shape_between(part.first, part.last));
    }
    const VerdictLanes<T> found = bounds_.judge(placements, left, right, shape);
    for (int lane = 0; lane < lanes_used(begin, end); ++lane) {
      const std::size_t index = begin + at(lane);
      if (items_[parts_[index].item].is_left) continue;
      parts_[index].verdict = found.verdict(lane);
      if (parts_[index].verdict == Verdict::open) take_open(index);
    }
  }

  // The wheel's own strips from `begin` on.
  void evaluate_strips(std::size_t begin) {
    const auto& of_wheel = wheel_.strips().strips();
    PlacementLanes<T> placements;
    Lanes<T> lateral;
    ProfilePointLanes<T> point;
    for (; begin < strips_.size(); begin += lane_count) {
      for (int lane = 0; lane < lane_count; ++lane) {
        const StripOf& wanted = strips_[in_lane(begin, lane, strips_.size())];
        const Strip<T>& strip = of_wheel[at(wanted.index)];
        placements.set(lane, items_[wanted.item].placement);
        lateral[lane] = strip.lateral;
        point.value[lane] = strip.point.value;
        point.slope[lane] = strip.point.slope;
        point.second_derivative[lane] = strip.point.second_derivative;
      }
      const auto found = locus_strips(wheel_, rail_, placements, lateral, point);
      for (int lane = 0; lane < lanes_used(begin, strips_.size()); ++lane) {
        StripOf& wanted = strips_[begin + at(lane)];
        wanted.strip = found.strip(lane, of_wheel[at(wanted.index)].piece, lateral[lane]);
        ++items_[wanted.item].evaluations;
      }
    }
  }

  // A part of which nothing is known.
  void take_open(std::size_t index) {
    Part& part = parts_[index];
    Item& item = items_[part.item];
    if (part.first + 1 < part.last) {
      divide(index);
      return;
    }
    const Judged &left = strips_[part.left].strip, &right = strips_[part.right].strip;
    const WheelPlacement<T> placement = placements_.at(item.index);
    const NearRuns<P, R> near(wheel_, rail_, placement,
                              T(options_.penetration_threshold - margin_));
    if (near.is_above(left, part.first, T(0)) || near.is_above(right, part.first, T(0))) {
      part.verdict = Verdict::excluded;
    } else {
      item.is_left = true;
    }
  }

  void divide(std::size_t index) {
    const Part part = parts_[index];
    const int between = part.first + (part.last - part.first) / 2;
    const std::size_t middle = add_strip(part.item, between);
    parts_[index].child = static_cast<int>(parts_.size());
    parts_.push_back({part.item, part.first, between, part.left, middle});
    parts_.push_back({part.item, between, part.last, middle, part.right});
  }

  [[nodiscard]] bool penetrates(const Judged& strip) const {
    return strip.exists && options_.penetration_threshold < strip.penetration;
  }

  // An extremum that matters: a maximum, or a minimum between two strips that penetrate.
  void ask_for_extremum(const Part& part) {
    if (part.verdict != Verdict::simple || part.child != none || items_[part.item].is_left) return;
    const Judged &left = strips_[part.left].strip, &right = strips_[part.right].strip;
    if (!left.exists || !right.exists) return;
    const bool is_maximum = T(0) < left.slope && right.slope < T(0);
    const bool is_minimum = left.slope < T(0) && T(0) < right.slope;
    if (!is_maximum && !(is_minimum && penetrates(left) && penetrates(right))) return;
    extrema_.push_back(static_cast<std::size_t>(&part - parts_.data()));
  }

  void solve_extrema() {
    PlacementLanes<T> placements;
    ProfileLanes<P> profile(wheel_.profile());
    LocusStripLanes<T> lower, upper;  // ends of parts
    for (std::size_t begin = 0; begin < extrema_.size(); begin += lane_count) {
      for (int lane = 0; lane < lane_count; ++lane) {
        const Part& part = parts_[extrema_[in_lane(begin, lane, extrema_.size())]];
        const Judged &left = strips_[part.left].strip, &right = strips_[part.right].strip;
        placements.set(lane, items_[part.item].placement);
        profile.set(lane, left.piece);
        lower.set(lane, left);
        upper.set(lane, right);
      }
      LocusStripLanes<T> found;
      Lanes<T> exist = Lanes<T>::Constant(T(1));
      const auto root = bracketed_newton_lanes<T>(
          [&](const Lanes<T>& u, Lanes<T>& value, Lanes<T>& slope) {
            found = locus_strips(wheel_, rail_, placements, u, profile.evaluate(u));
            exist = exist * found.exists;
            value = found.slope;
            slope = found.slope_rate;
          },
          lower.wheel_lateral, upper.wheel_lateral, less<T>(lower.slope, Lanes<T>::Zero()),
          extremum_guess<T>(lower, upper, options_.penetration_threshold), newton_.extremum());
      for (int lane = 0; lane < lanes_used(begin, extrema_.size()); ++lane) {
        Part& part = parts_[extrema_[begin + at(lane)]];
        take_root(root, exist, lane, items_[part.item]);
        part.extremum = static_cast<int>(strips_.size());
        const int piece = strips_[part.left].strip.piece;
        strips_.push_back({found.strip(lane, piece, root.position[lane]), part.item});
      }
    }
  }

  // Counts what was evaluated; a placement whose root was not found is left to the search of one.
  static void take_root(const RootLanes<T>& root, const Lanes<T>& exist, int lane, Item& item) {
    item.evaluations += count_of<T>(root.iterations[lane]);
    item.is_left = item.is_left || !(T(0) < root.is_converged[lane]) || !(T(0) < exist[lane]);
  }

  // A walk along one placement's strips: opens, deepens and closes zones, as StripWalk does.
  struct Walk {
    std::size_t item = 0;
    int reached = none;         // the wheel's strip that was visited last
    int last = none;            // the strip that was visited last
    bool zone_is_open = false;  // the last one of zones_
  };

  void walk(std::size_t item) {
    if (items_[item].is_left) return;
    Walk walk{item};
    for (int run = items_[item].first_run; run != none; run = parts_[at(run)].next_run) {
      walk_part(walk, parts_[at(run)]);
    }
    leave_zone(walk);
  }

  void walk_part(Walk& walk, const Part& part) {
    if (part.child != none) {
      walk_part(walk, parts_[at(part.child)]);
      walk_part(walk, parts_[at(part.child + 1)]);
      return;
    }
    if (part.verdict == Verdict::excluded) return;
    if (part.first != walk.reached) {
      const bool neighbours =
          0 <= walk.reached && part.first == walk.reached + 1 &&
          strips_[at(walk.last)].strip.wheel_lateral == strips_[part.left].strip.wheel_lateral;
      if (!neighbours) leave_zone(walk);
      visit(walk, part.left);
    }
    walk.reached = part.last;
    if (part.extremum != none) visit(walk, at(part.extremum));
    visit(walk, part.right);
  }

  void visit(Walk& walk, std::size_t next) {
    const Judged& strip = strips_[next].strip;
    const bool inside = penetrates(strip);
    const bool follows = walk.last != none && strips_[at(walk.last)].strip.exists;
    if (inside && !walk.zone_is_open) {
      walk.zone_is_open = true;
      zones_.push_back({walk.item, next, strip.wheel_lateral, T(0) / T(0), !follows});
      if (follows || !options_.zone_ends) ask_for_end(walk, next, true);
    } else if (!inside && walk.zone_is_open) {
      walk.zone_is_open = false;
      zones_.back().is_cut = zones_.back().is_cut || !strip.exists;
      zones_.back().upper = strips_[at(walk.last)].strip.wheel_lateral;
      if (strip.exists) ask_for_end(walk, next, false);
    } else if (inside && strips_[zones_.back().deepest].strip.penetration < strip.penetration) {
      zones_.back().deepest = next;
    }
    walk.last = static_cast<int>(next);
  }

  void leave_zone(Walk& walk) {
    if (walk.zone_is_open) {
      zones_.back().is_cut = true;
      zones_.back().upper = strips_[at(walk.last)].strip.wheel_lateral;
      walk.zone_is_open = false;
    }
    walk.last = none;
  }

  // Of the last zone, between the walk's last strip and the next one.
  void ask_for_end(const Walk& walk, std::size_t next, bool is_lower) {
    T& known = is_lower ? zones_.back().lower : zones_.back().upper;
    if (!options_.zone_ends) {
      known = T(0) / T(0);
      return;
    }
    const Judged &left = strips_[at(walk.last)].strip, &right = strips_[next].strip;
    if (left.wheel_lateral == right.wheel_lateral) {
      known = left.wheel_lateral;
    } else if (left.piece == right.piece) {
      ends_.push_back({zones_.size() - 1, at(walk.last), next, is_lower});
    } else {
      items_[walk.item].is_left = true;
    }
  }

  void solve_ends() {
    PlacementLanes<T> placements;
    ProfileLanes<P> profile(wheel_.profile());
    LocusStripLanes<T> lower, upper;
    Lanes<T> rising;
    for (std::size_t begin = 0; begin < ends_.size(); begin += lane_count) {
      for (int lane = 0; lane < lane_count; ++lane) {
        const ZoneEnd& end = ends_[in_lane(begin, lane, ends_.size())];
        const Judged &left = strips_[end.left].strip, &right = strips_[end.right].strip;
        placements.set(lane, items_[zones_[end.zone].item].placement);
        profile.set(lane, left.piece);
        lower.set(lane, left);
        upper.set(lane, right);
        rising[lane] = T(end.is_lower ? 1 : 0);
      }
      Lanes<T> exist = Lanes<T>::Constant(T(1));
      const auto root = bracketed_newton_lanes<T>(
          [&](const Lanes<T>& u, Lanes<T>& value, Lanes<T>& slope) {
            const auto found = locus_strips(wheel_, rail_, placements, u, profile.evaluate(u));
            exist = exist * found.exists;
            value = found.penetration - options_.penetration_threshold;
            slope = found.slope;
          },
          lower.wheel_lateral, upper.wheel_lateral, rising,
          boundary_guess<T>(lower, upper, T(1) - rising, options_.penetration_threshold),
          newton_.zone_end());
      for (int lane = 0; lane < lanes_used(begin, ends_.size()); ++lane) {
        const ZoneEnd& end = ends_[begin + at(lane)];
        Zone& zone = zones_[end.zone];
        take_root(root, exist, lane, items_[zone.item]);
        (end.is_lower ? zone.lower : zone.upper) = root.position[lane];
      }
    }
  }

  void report(std::span<ContactResult<T>> results) {
    const bool is_proved = wheel_.strips().is_proved() && rail_.is_proved_convex();
    for (const Item& item : items_) {
      ContactResult<T>& result = results[item.index];
      result.patches.clear();
      result.status = SearchStatus::complete;
      result.evaluations = item.evaluations;
      result.is_proved = is_proved;
    }
    add_patches(results);
    for (const Item& item : items_) {
      if (!item.is_left) continue;
      results[item.index] =
          find_contact<P, R>(wheel_, rail_, placements_.at(item.index), options_, nullptr);
      results[item.index].evaluations += item.evaluations;
    }
  }

  // As patch_on_strip has them; all but the locus and its foot is done one by one.
  void add_patches(std::span<ContactResult<T>> results) {
    PlacementLanes<T> placements;
    ProfileLanes<P> profile(wheel_.profile());
    Lanes<T> lateral;
    for (std::size_t begin = 0; begin < zones_.size(); begin += lane_count) {
      for (int lane = 0; lane < lane_count; ++lane) {
        const Zone& zone = zones_[in_lane(begin, lane, zones_.size())];
        const Judged& deepest = strips_[zone.deepest].strip;
        placements.set(lane, items_[zone.item].placement);
        profile.set(lane, deepest.piece);
        lateral[lane] = deepest.wheel_lateral;
      }
      const ProfilePointLanes<T> point = profile.evaluate(lateral);
      const LocusPointLanes<T> locus = locus_points(wheel_, placements, lateral, point);
      const ClosestPointLanes<T> foot = rail_feet(rail_.profile(), locus.lateral, locus.up);
      for (int lane = 0; lane < lanes_used(begin, zones_.size()); ++lane) {
        const Zone& zone = zones_[begin + at(lane)];
        const Item& item = items_[zone.item];
        if (item.is_left) continue;
        const int piece = strips_[zone.deepest].strip.piece;
        ContactResult<T>& result = results[item.index];
        ++result.evaluations;
        if (options_.maximum_penetration < foot.penetration[lane]) {
          result.status = SearchStatus::too_deep;
        }
        const bool has_room = result.patches.push_back_made([&] {
          Patch<T> patch =
              patch_at(wheel_, placements_.at(item.index), piece, lateral[lane],
                       {point.value[lane], point.slope[lane], point.second_derivative[lane]},
                       {locus.sine[lane], locus.cosine[lane]},
                       {foot.lateral[lane],
                        foot.penetration[lane],
                        {foot.normal_lateral[lane], foot.normal_up[lane]},
                        foot.curvature[lane]});
          patch.zone_lower = zone.lower;
          patch.zone_upper = zone.upper;
          patch.zone_is_cut = zone.is_cut;
          return patch;
        });
        if (!has_room) result.status = SearchStatus::too_many_patches;
      }
    }
  }

  const Wheel<P>& wheel_;
  const Rail<R>& rail_;
  const PlacementBatch<T>& placements_;
  const SearchOptions<T>& options_;
  T margin_;  // as in StripWalk
  PenetrationBoundsLanes<R> bounds_;
  NewtonEnds<T> newton_;
  std::vector<Item> items_;
  std::vector<StripOf> strips_;
  std::vector<Part> parts_;
  std::vector<std::size_t> extrema_;  // parts
  std::vector<Zone> zones_;
  std::vector<ZoneEnd> ends_;
};

}  // namespace wheelrail::detail
