#pragma once
#include <boost/system/error_code.hpp>
#include <memory>
#include <string>
#include <string_view>

#include "budget.hpp"
#include "service/batch/spool.hpp"

namespace turnwright::service {

/// A body while it arrives: in memory, or in the file of a batch.  What it takes is
/// counted before it is allocated or written.
class Intake {
 public:
  /// @param spool  null: the body is kept in memory.
  Intake(Budget& budget, std::shared_ptr<Spool> spool);

  /// @return not_enough_memory or no_space_on_device, with the piece lost, if there is no
  ///   room.
  boost::system::error_code take(std::string_view piece);

  std::string text;  ///< of a body in memory
  const std::shared_ptr<Spool>& spool() const { return spool_; }

 private:
  Budget::Share share_;
  std::shared_ptr<Spool> spool_;
};

}  // namespace turnwright::service
