#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "document/json/parse.hpp"
#include "service/requests.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/document/catalogue.hpp"

/// What a fuzzer asks of a document: an answer, or a refusal of the kinds that are told
/// to callers.  All else ends the fuzzer.
namespace turnwright::fuzz {

inline const document::Catalogue& catalogue() {
  static const auto kCatalogue = document::load_catalogue(TURNWRIGHT_SOURCE_DIR);
  return kCatalogue;
}

/// The row of that name; ends the program if there is none.
inline const service::Request& door_named(const std::string& name) {
  for (const auto& row : service::requests())
    if (row.name == name) return row;
  std::cerr << "no door " << name << '\n';
  std::exit(2);
}

/// Asks for the work's end after some time; most of the work of a plan is no news.
class Patience {
 public:
  explicit Patience(std::chrono::milliseconds time)
      : waiting_([this, time](const std::stop_token& given_up) {
          std::unique_lock lock(mutex_);
          if (!changed_.wait_for(lock, given_up, time, [] { return false; }))
            if (!given_up.stop_requested()) work_.request_stop();
        }) {}
  std::stop_token token() const { return work_.get_token(); }

 private:
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::stop_source work_;
  std::jthread waiting_;  // the last: it is ended first
};

inline void answered(const service::Request& row, const nlohmann::json& request) {
  const Patience patience(std::chrono::milliseconds(500));
  const service::Context context{catalogue(), patience.token()};
  try {
    service::Drawn drawn;
    if (row.drawn)
      drawn = service::drawn_answer(row, request, context);
    else
      drawn.result = service::answer(row, request, context);
    (void)drawn.result.dump();
    if (row.text) (void)row.text(drawn.result);
    if (row.html) (void)service::html_report(row, request, drawn);
  } catch (const InputError&) {
  } catch (const ModelRangeError&) {
  } catch (const Cancelled&) {
  }
}

}  // namespace turnwright::fuzz
