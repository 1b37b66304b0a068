#include "known_answers.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

namespace turnwright::service {
namespace {

// A file that no other process reads need not survive this one; a million pages of 4 kB.
constexpr const char* kSetUp = R"(
PRAGMA synchronous = OFF;
PRAGMA journal_mode = MEMORY;
PRAGMA max_page_count = 1000000;
CREATE TABLE known (digest TEXT PRIMARY KEY, text TEXT NOT NULL, status INTEGER NOT NULL)
)";

}  // namespace

struct KnownAnswers::Store {
  SQLite::Database database{"", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE};
  int set_up = database.exec(kSetUp);
  SQLite::Statement find{database, "SELECT text, status FROM known WHERE digest = ?"};
  SQLite::Statement keep{database, "INSERT OR IGNORE INTO known VALUES (?, ?, ?)"};
};

KnownAnswers::KnownAnswers() : store_(std::make_unique<Store>()) {}
KnownAnswers::~KnownAnswers() = default;

std::optional<BatchRecord> KnownAnswers::find(const std::string& digest) const {
  const std::lock_guard lock(mutex_);
  auto& query = store_->find;
  query.bindNoCopy(1, digest);
  std::optional<BatchRecord> known;
  if (query.tryExecuteStep() == SQLITE_ROW)
    known = {query.getColumn(0).getString(),
             static_cast<BatchStatus>(query.getColumn(1).getInt())};
  query.tryReset();
  return known;
}

void KnownAnswers::keep(const std::string& digest, const BatchRecord& record) {
  const std::lock_guard lock(mutex_);
  if (full_ || record.status == BatchStatus::error) return;
  auto& insert = store_->keep;
  insert.bindNoCopy(1, digest);
  insert.bindNoCopy(2, record.text);
  insert.bind(3, static_cast<int>(record.status));
  full_ = insert.tryExecuteStep() != SQLITE_DONE;
  insert.tryReset();
}

}  // namespace turnwright::service
