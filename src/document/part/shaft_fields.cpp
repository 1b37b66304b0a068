#include "shaft_fields.hpp"

namespace turnwright::document {
namespace {

constexpr std::size_t kSegments = 10000;
const Bounds kLength = above_up_to(0, 1e6, "mm"), kOuter = above_up_to(0, 1e5, "mm"),
             kInner = within(0, 1e5, "mm");

using More = std::function<void(Reader&, const part::Segment&)>;

part::Segment read_segment(Reader r, const More& more) {
  r = r.as_object();
  const part::Segment s{.length_mm = r.number("length_mm", kLength),
                        .outer_left_mm = r.number("outer_left_mm", kOuter),
                        .outer_right_mm = r.number("outer_right_mm", kOuter),
                        .inner_left_mm = r.number_or("inner_left_mm", kInner, 0),
                        .inner_right_mm = r.number_or("inner_right_mm", kInner, 0)};
  if (more) more(r, s);
  r.finish();
  const auto wall = [&r](const char* key, double inner, double outer) {
    if (inner >= outer)
      r.problem_at(key, expected_number(at_least_below(0, outer, "mm")), "conflict");
  };
  wall("inner_left_mm", s.inner_left_mm, s.outer_left_mm);
  wall("inner_right_mm", s.inner_right_mm, s.outer_right_mm);
  return s;
}

}  // namespace

part::Shaft read_shaft(Reader r, const More& more) {
  part::Shaft shaft{.E_MPa = r.number("E_MPa", above_up_to(0, 1e7, "MPa")),
                    .nu = r.number("nu", at_least_below(0, 0.5)),
                    .segments = {}};
  for (const Reader& item : r.items("segments", 1, kSegments))
    shaft.segments.push_back(read_segment(item, more));
  r.finish();
  return shaft;
}

}  // namespace turnwright::document
