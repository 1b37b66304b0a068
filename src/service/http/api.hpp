#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <stop_token>
#include <string>

#include "message.hpp"
#include "page.hpp"
#include "service/batch/batches.hpp"

namespace turnwright::service {

/// The HTTP API without sockets:
///
///     POST   /v1/{name}                     every row of the request table
///     POST   /v1/{name}/report              as HTML, for rows that have a report
///     GET    /v1/materials|tools|machines|shops|parts[/{id}]
///     POST   /v1/batches                    JSON lines {"name", "document"} -> 202, job
///     GET    /v1/batches[/{id}[/results?from=n]]
///     POST   /v1/batches/{id}/cancel
///     DELETE /v1/batches/{id}
///     GET    /healthz, /readyz, /metrics, /openapi.json, /
///
/// HEAD is GET without the body; OPTIONS lists the methods of a path, OPTIONS * all
/// methods. Every error is a problem document.  May be called from several threads.
class HttpApi {
 public:
  /// Returns the page at "/"; called for every answer.
  using Page = std::function<std::string()>;

  /// @param batches  nullptr: this server takes no batches (404).
  /// @throws InputError if the folder's documents cannot be read.
  HttpApi(const std::filesystem::path& data_folder, const document::Catalogue& catalogue,
          Batches* batches, Page page = built_in_page);

  /// The answer to calls that need no computing: OPTIONS, and methods, paths or queries
  /// that are not part of this API; none for other calls.
  std::optional<Reply> at_once(const Call& call) const;

  /// The answer to a call; `stop` ends long computations.  /readyz and /metrics are
  /// answered by the server itself.
  /// @throws Cancelled if a stop was requested.
  Reply reply(const Call& call, std::stop_token stop) const;

  /// Where the body of a batch is kept while it arrives; null for other calls.
  std::shared_ptr<Spool> spool(const Call& call) const;

  /// Largest permitted body of a call [bytes].
  static std::size_t body_limit(const Call& call);

  /// The path with ids replaced by placeholders, "/v1/parts/{id}"; "other" for paths that
  /// are not part of this API.  It is used for metrics, which need few different values.
  std::string route(const Call& call) const;

 private:
  struct Route;
  struct Listing {
    std::string index;                             ///< all ids and names, JSON
    std::map<std::string, std::string> documents;  ///< as written, by id
  };
  static const std::vector<Route>& routes();

  const document::Catalogue& catalogue_;
  Batches* batches_;
  Page page_;
  std::map<std::string, Listing> listings_;  ///< by "materials", ..
  std::string openapi_;
};

}  // namespace turnwright::service
