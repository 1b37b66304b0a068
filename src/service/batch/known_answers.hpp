#pragma once
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "line.hpp"

namespace turnwright::service {

/// Records by the digest of their request, in a temporary SQLite file of this process
/// ($SQLITE_TMPDIR, $TMPDIR, /var/tmp, ..) that no one else sees and that ends with it:
/// memory stays that of SQLite's page cache.  Where the disk refuses or 4 GB are reached,
/// it keeps no more.  Safe from several threads.
class KnownAnswers {
 public:
  KnownAnswers();
  ~KnownAnswers();

  std::optional<BatchRecord> find(const std::string& digest) const;
  /// Errors are not kept: they cost nothing to find again.
  void keep(const std::string& digest, const BatchRecord& record);

 private:
  struct Store;
  mutable std::mutex mutex_;
  std::unique_ptr<Store> store_;
  bool full_ = false;
};

}  // namespace turnwright::service
