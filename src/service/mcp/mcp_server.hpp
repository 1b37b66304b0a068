#pragma once
#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <string_view>
#include <thread>

#include "messages.hpp"
#include "turnwright/document/catalogue.hpp"

namespace turnwright::service::mcp {

struct Limits {
  std::chrono::milliseconds deadline{60'000};  ///< of one call
  std::size_t waiting = 16;                    ///< calls behind the one that is computed
};

/// Answers messages of the Model Context Protocol.  Calls of tools are computed one after
/// the other on a thread of their own, all else is answered at once.
class Server {
 public:
  /// Sends a message to the client; called by one thread at a time.
  using Send = std::function<void(const nlohmann::ordered_json& message)>;

  /// @param catalogue  outlives the server.
  /// @throws InputError if a document of the folder cannot be read.
  Server(const std::filesystem::path& folder, const document::Catalogue& catalogue,
         Send send, Limits limits = {});
  ~Server();  ///< when every call has its answer
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Takes the client's next message, one line of JSON.
  void receive(std::string_view line);

 private:
  struct Call {
    const Request* row;
    nlohmann::json id, arguments, progress;  ///< progress: the client's token, or null
    std::stop_source stop;
  };

  void send(const nlohmann::ordered_json& message);
  void refuse(const nlohmann::json& id);
  void answer_request(const nlohmann::json& id, const std::string& method,
                      const nlohmann::json& parameters);
  void take_call(const nlohmann::json& id, const nlohmann::json& parameters);
  void cancel(const nlohmann::json& parameters);
  void work();
  /// None if the client has cancelled the call.
  std::optional<nlohmann::ordered_json> answered(const Call& call);

  const document::Catalogue& catalogue_;
  const Send send_;
  const Limits limits_;
  const Resources resources_;
  std::mutex sending_, calling_;
  std::condition_variable changed_;
  std::deque<Call> calls_;  ///< the first is being computed
  bool closed_ = false;     ///< no further call will come
  std::thread worker_;
};

}  // namespace turnwright::service::mcp
