#include "base/say.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::planning {

std::string setup_label(std::size_t index) { return say("setup {}", index + 1); }

const char* name(Clamping c) {
  switch (c) {
    case Clamping::chuck:
      return to_translate("chuck");
    case Clamping::chuck_tailstock:
      return to_translate("chuck-tailstock");
    case Clamping::between_centres:
      return to_translate("between-centres");
    case Clamping::chuck_steady:
      return to_translate("chuck-steady");
    case Clamping::tailstock_follow:
      return to_translate("tailstock-follow");
  }
  return "";
}

const char* name(Jaws jaws) {
  switch (jaws) {
    case Jaws::hard:
      return to_translate("hard");
    case Jaws::soft:
      return to_translate("soft");
    case Jaws::collet:
      return to_translate("collet");
  }
  return "";
}

const char* name(OperationKind k) {
  switch (k) {
    case OperationKind::face:
      return to_translate("face");
    case OperationKind::rough:
      return to_translate("rough");
    case OperationKind::finish:
      return to_translate("finish");
    case OperationKind::bore_rough:
      return to_translate("bore-rough");
    case OperationKind::bore_finish:
      return to_translate("bore-finish");
    case OperationKind::fixed:
      return to_translate("fixed");
    case OperationKind::mill:
      return to_translate("mill");
    case OperationKind::cross_drill:
      return to_translate("cross-drill");
  }
  return "";
}

const char* name(MilledKind k) {
  switch (k) {
    case MilledKind::flat:
      return to_translate("flat");
    case MilledKind::keyway:
      return to_translate("keyway");
    case MilledKind::slot:
      return to_translate("slot");
    case MilledKind::cross_hole:
      return to_translate("cross-hole");
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
  return d == Direction::to_chuck ? to_translate("to-chuck") : to_translate("from-chuck");
}

const char* name(Verdict v) {
  switch (v) {
    case Verdict::met:
      return to_translate("met");
    case Verdict::met_with_offset:
      return to_translate("met-with-offset");
    case Verdict::not_met:
      return to_translate("not-met");
  }
  return "";
}

}  // namespace turnwright::planning
