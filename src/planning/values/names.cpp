#include "turnwright/planning/process_plan.hpp"

namespace turnwright::planning {

std::string setup_label(std::size_t index) {
  return "setup " + std::to_string(index + 1);
}

const char* name(Clamping c) {
  switch (c) {
    case Clamping::chuck:
      return "chuck";
    case Clamping::chuck_tailstock:
      return "chuck-tailstock";
    case Clamping::between_centres:
      return "between-centres";
    case Clamping::chuck_steady:
      return "chuck-steady";
    case Clamping::tailstock_follow:
      return "tailstock-follow";
  }
  return "";
}

const char* name(Jaws jaws) {
  switch (jaws) {
    case Jaws::hard:
      return "hard";
    case Jaws::soft:
      return "soft";
    case Jaws::collet:
      return "collet";
  }
  return "";
}

const char* name(OperationKind k) {
  switch (k) {
    case OperationKind::face:
      return "face";
    case OperationKind::rough:
      return "rough";
    case OperationKind::finish:
      return "finish";
    case OperationKind::bore_rough:
      return "bore-rough";
    case OperationKind::bore_finish:
      return "bore-finish";
    case OperationKind::fixed:
      return "fixed";
    case OperationKind::mill:
      return "mill";
    case OperationKind::cross_drill:
      return "cross-drill";
  }
  return "";
}

const char* name(MilledKind k) {
  switch (k) {
    case MilledKind::flat:
      return "flat";
    case MilledKind::keyway:
      return "keyway";
    case MilledKind::slot:
      return "slot";
    case MilledKind::cross_hole:
      return "cross-hole";
  }
  return "";
}

const char* name(Through t) {
  switch (t) {
    case Through::no:
      return "no";
    case Through::wall:
      return "wall";
    case Through::part:
      return "part";
  }
  return "";
}

const char* name(Direction d) {
  return d == Direction::to_chuck ? "to-chuck" : "from-chuck";
}

const char* name(Verdict v) {
  switch (v) {
    case Verdict::met:
      return "met";
    case Verdict::met_with_offset:
      return "met-with-offset";
    case Verdict::not_met:
      return "not-met";
  }
  return "";
}

}  // namespace turnwright::planning
