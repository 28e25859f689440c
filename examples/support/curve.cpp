#include "curve.hpp"

namespace examples {

wheelrail::NodalTrack<RailHead> curved_track(const RailHead& rail, const CurveLayout& layout,
                                             const wheelrail::TrackDimensions<double>& dimensions) {
  using Segment = wheelrail::TrackSegment<double>;
  return wheelrail::NodalTrack<RailHead>(
      rail,
      wheelrail::CentreLine<double>(
          {Segment::tangent(layout.approach), Segment::clothoid(layout.transition),
           Segment::arc(layout.arc, layout.radius, wheelrail::Side::left, layout.cant),
           Segment::clothoid(layout.transition), Segment::tangent(layout.departure)}),
      dimensions);
}

}  // namespace examples
