#include "intake.hpp"

#include <algorithm>

#include "service/log.hpp"
#include "service/output.hpp"

namespace turnwright::service {
namespace {

using boost::system::error_code;
namespace errc = boost::system::errc;

constexpr std::size_t kFirst = 4096;  // bytes; doubled as often as needed

error_code keep(Spool& spool, std::string_view piece) {
  try {
    spool.write(piece);
    return {};
  } catch (const OutputError& error) {
    log_event("batch refused", error.what());
    return make_error_code(errc::no_space_on_device);
  }
}

}  // namespace

Intake::Intake(Budget& budget, std::shared_ptr<Spool> spool)
    : share_(budget), spool_(std::move(spool)) {}

error_code Intake::take(std::string_view piece) {
  if (piece.empty()) return {};
  if (spool_) {
    if (!share_.resize(share_.bytes() + piece.size()))
      return make_error_code(errc::no_space_on_device);
    return keep(*spool_, piece);
  }
  const auto size = text.size() + piece.size();
  if (size > text.capacity()) {
    const auto room = std::max({size, 2 * text.capacity(), kFirst});
    if (!share_.resize(room)) return make_error_code(errc::not_enough_memory);
    text.reserve(room);
  }
  text += piece;
  return {};
}

}  // namespace turnwright::service
