#include "job_store.hpp"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <stdexcept>

#include "base/say.hpp"
#include "fatal_lines.hpp"
#include "line.hpp"
#include "spool.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::service {
namespace {

constexpr int kSchemaVersion = 2;

// Long texts are kept out of keys, because a key is found by comparisons.
constexpr const char* kTables = R"(
CREATE TABLE job (id INTEGER PRIMARY KEY AUTOINCREMENT, state TEXT NOT NULL,
                  data TEXT NOT NULL, lines INTEGER NOT NULL, open INTEGER NOT NULL,
                  errors INTEGER NOT NULL DEFAULT 0);
CREATE TABLE line (id INTEGER PRIMARY KEY,
                   job INTEGER NOT NULL REFERENCES job(id) ON DELETE CASCADE,
                   number INTEGER NOT NULL, request TEXT NOT NULL, digest TEXT,
                   record TEXT);
CREATE UNIQUE INDEX line_number ON line(job, number);
CREATE INDEX line_digest ON line(digest) WHERE digest IS NOT NULL;
)";

// A job is continued as long as all its records come from the same data.
constexpr const char* kAdopt =
    "UPDATE job SET data = ?1 WHERE state = 'running' AND NOT EXISTS "
    "(SELECT 1 FROM line WHERE line.job = job.id AND record IS NOT NULL)";
constexpr const char* kOutdate =
    "UPDATE job SET state = 'outdated' WHERE state = 'running' AND data <> ?1";

int integer(SQLite::Database& database, const char* query) {
  return database.execAndGet(query).getInt();
}

/// Whether the file is new.  @throws std::runtime_error if it is another program's.
bool is_new(SQLite::Database& database) {
  const int version = integer(database, "PRAGMA user_version");
  if (version == 0 && integer(database, "SELECT count(*) FROM sqlite_master") == 0)
    return true;
  const int own = integer(database,
                          "SELECT count(*) FROM sqlite_master WHERE name IN "
                          "('job', 'line', 'line_digest')");
  if (own != 3) throw std::runtime_error(tr("a database of another program"));
  if (version != kSchemaVersion)
    throw std::runtime_error(
        say("a job store of version {}, but this program reads only version {}", version,
            kSchemaVersion));
  return false;
}

void open_or_make(SQLite::Database& database, const std::string& data) {
  database.setBusyTimeout(1000);
  database.exec("PRAGMA locking_mode = EXCLUSIVE; PRAGMA foreign_keys = ON");
  is_new(database);
  database.exec("PRAGMA journal_mode = WAL");
  database.exec("PRAGMA synchronous = FULL");
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  if (is_new(database)) {
    database.exec(kTables);
    database.exec("PRAGMA user_version = " + std::to_string(kSchemaVersion));
  }
  for (const char* change : {kAdopt, kOutdate}) {
    SQLite::Statement update(database, change);
    update.bind(1, data);
    update.exec();
  }
  transaction.commit();
}

Job job_of(SQLite::Statement& row) {
  const std::int64_t lines = row.getColumn(2), open = row.getColumn(3);
  return {row.getColumn(0), row.getColumn(1).getString(), lines, lines - open,
          row.getColumn(4)};
}

constexpr const char* kJobColumns = "SELECT id, state, lines, open, errors FROM job ";

bool blank(std::string_view line) {
  return line.find_first_not_of(" \t\r") == std::string_view::npos;
}

/// A job without its lines.  @return its id.
std::int64_t new_job(SQLite::Database& database, const std::string& data) {
  SQLite::Statement job(database,
                        "INSERT INTO job (state, data, lines, open) VALUES (?, ?, 0, 0)");
  job.bind(1, "running");
  job.bind(2, data);
  job.exec();
  return database.getLastInsertRowid();
}

void tell_lines(SQLite::Database& database, std::int64_t id, std::int64_t lines,
                std::int64_t open) {
  SQLite::Statement job(database,
                        "UPDATE job SET state = ?, lines = ?, open = ? WHERE id = ?");
  job.bind(1, open == 0 ? "done" : "running");
  job.bind(2, lines);
  job.bind(3, open);
  job.bind(4, id);
  job.exec();
}

}  // namespace

JobStore::JobStore(const std::filesystem::path& file, std::string data) try
    : file_(file),
      fatal_file_(file.string() + "-fatal"),
      data_(std::move(data)),
      database_(std::make_unique<SQLite::Database>(
          file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)) {
  open_or_make(*database_, data_);
  finish_fatal_lines();
} catch (const std::runtime_error& error) {
  throw std::runtime_error(file.string() + ": " + error.what());
}

JobStore::~JobStore() = default;

void JobStore::finish_fatal_lines() {
  std::vector<Record> records;
  for (const auto& [id, number] : FatalLines::noted(fatal_file_))
    if (const auto found = job(id); found && found->state == "running")
      records.push_back({id, number, {}, fatal_record().text, true});
  finish(records);
  std::filesystem::remove(fatal_file_);
}

std::shared_ptr<Spool> JobStore::spool() const { return std::make_shared<Spool>(file_); }

std::optional<std::int64_t> JobStore::submit(std::string_view text,
                                             const std::stop_token& stop) {
  return submit(
      [&text](std::string& line) {
        if (text.empty()) return false;
        const auto end = std::min(text.find('\n'), text.size());
        line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        return true;
      },
      stop);
}

std::optional<std::int64_t> JobStore::submit(const NextLine& next,
                                             const std::stop_token& stop) {
  const std::lock_guard lock(mutex_);
  SQLite::Transaction transaction(*database_);
  const std::int64_t id = new_job(*database_, data_);
  SQLite::Statement insert(*database_,
                           "INSERT INTO line (job, number, request) VALUES (?, ?, ?)");
  std::int64_t lines = 0;
  std::size_t open = 0;
  for (std::string line; next(line);) {
    leave_if(stop);
    ++lines;
    if (blank(line)) continue;
    if (++open > kMostLines) return std::nullopt;  // what was stored is taken back
    insert.bind(1, id);
    insert.bind(2, lines);
    insert.bindNoCopy(3, line);
    insert.exec();
    insert.reset();
  }
  tell_lines(*database_, id, lines, static_cast<std::int64_t>(open));
  transaction.commit();
  return id;
}

std::optional<Job> JobStore::job(std::int64_t id) const {
  const std::lock_guard lock(mutex_);
  SQLite::Statement query(*database_, std::string(kJobColumns) + "WHERE id = ?");
  query.bind(1, id);
  if (!query.executeStep()) return std::nullopt;
  return job_of(query);
}

std::vector<Job> JobStore::jobs() const {
  const std::lock_guard lock(mutex_);
  SQLite::Statement query(*database_, std::string(kJobColumns) + "ORDER BY id");
  std::vector<Job> all;
  while (query.executeStep()) all.push_back(job_of(query));
  return all;
}

bool JobStore::cancel(std::int64_t id) {
  const std::lock_guard lock(mutex_);
  SQLite::Statement update(
      *database_,
      "UPDATE job SET state = CASE state WHEN 'running' THEN 'cancelled' ELSE state END "
      "WHERE id = ?");
  update.bind(1, id);
  return update.exec() > 0;
}

bool JobStore::remove(std::int64_t id) {
  const std::lock_guard lock(mutex_);
  SQLite::Statement erase(*database_, "DELETE FROM job WHERE id = ?");
  erase.bind(1, id);
  return erase.exec() > 0;
}

std::vector<JobStore::Line> JobStore::take(std::size_t count) {
  const std::lock_guard lock(mutex_);
  std::vector<Line> lines;
  auto taken = taken_;
  SQLite::Statement running(*database_,
                            "SELECT id FROM job WHERE state = 'running' ORDER BY id");
  while (lines.size() < count && running.executeStep()) {
    const std::int64_t id = running.getColumn(0);
    SQLite::Statement query(*database_,
                            "SELECT number, request FROM line WHERE job = ? AND "
                            "number > ? AND record IS NULL ORDER BY number LIMIT ?");
    query.bind(1, id);
    query.bind(2, taken[id]);
    query.bind(3, static_cast<std::int64_t>(count - lines.size()));
    while (query.executeStep()) {
      taken[id] = query.getColumn(0);
      lines.push_back({id, taken[id], query.getColumn(1).getString()});
    }
  }
  taken_ = std::move(taken);
  return lines;
}

std::optional<std::string> JobStore::known(const std::string& digest) const {
  const std::lock_guard lock(mutex_);
  SQLite::Statement query(*database_,
                          "SELECT record FROM line JOIN job ON job.id = line.job "
                          "WHERE digest = ? AND data = ? LIMIT 1");
  query.bind(1, digest);
  query.bind(2, data_);
  if (!query.executeStep()) return std::nullopt;
  return query.getColumn(0).getString();
}

void JobStore::finish(std::span<const Record> records) {
  const std::lock_guard lock(mutex_);
  SQLite::Transaction transaction(*database_);
  SQLite::Statement store(*database_,
                          "UPDATE line SET record = ?, digest = ? WHERE job = ? AND "
                          "number = ? AND record IS NULL");
  SQLite::Statement count(
      *database_,
      "UPDATE job SET open = open - 1, errors = errors + ?1, state = CASE WHEN open = 1 "
      "AND state = 'running' THEN 'done' ELSE state END WHERE id = ?2");
  for (const auto& record : records) {
    store.bindNoCopy(1, record.text);
    if (record.digest.empty())
      store.bind(2);
    else
      store.bindNoCopy(2, record.digest);
    store.bind(3, record.job);
    store.bind(4, record.number);
    const int stored = store.exec();
    store.reset();
    if (stored == 0) continue;  // the job was removed meanwhile
    count.bind(1, record.error ? 1 : 0);
    count.bind(2, record.job);
    count.exec();
    count.reset();
  }
  transaction.commit();
}

JobStore::Results JobStore::results(std::int64_t id, std::int64_t from,
                                    std::size_t bytes) const {
  const std::lock_guard lock(mutex_);
  SQLite::Statement query(*database_,
                          "SELECT number, record FROM line WHERE job = ? AND "
                          "number >= ? ORDER BY number");
  query.bind(1, id);
  query.bind(2, from);
  Results results{{}, from};
  while (results.jsonl.size() < bytes && query.executeStep()) {
    if (query.getColumn(1).isNull()) break;
    const std::int64_t number = query.getColumn(0);
    results.jsonl += numbered(number, query.getColumn(1).getString()) + '\n';
    results.next = number + 1;
  }
  return results;
}

}  // namespace turnwright::service
