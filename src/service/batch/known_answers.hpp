#pragma once
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "line.hpp"

namespace turnwright::service {

/// Records by the digest of their request, in a temporary SQLite file of this process
/// ($SQLITE_TMPDIR, $TMPDIR, /var/tmp, ..) that is private to it and ends with it.
/// Memory is that of SQLite's page cache.  If the disk is full or 4 GB are reached no
/// more records are kept.  May be used from several threads.
class KnownAnswers {
 public:
  KnownAnswers();
  ~KnownAnswers();

  std::optional<BatchRecord> find(const std::string& digest) const;
  /// Keeps a record, unless it is an error, which is found again at no cost.
  void keep(const std::string& digest, const BatchRecord& record);

 private:
  struct Store;
  mutable std::mutex mutex_;
  std::unique_ptr<Store> store_;
  bool full_ = false;
};

}  // namespace turnwright::service
