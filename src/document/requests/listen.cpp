#include "turnwright/document/listen.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "document/exchange/given_file.hpp"
#include "document/json/fields.hpp"
#include "document/json/read_below.hpp"
#include "document/response/wav_file.hpp"
#include "stability_request.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/chatter/sound.hpp"
#include "turnwright/document/stability.hpp"

namespace turnwright::document {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

struct ListenRequest {
  WavFile wav;
  std::size_t channel = 0;
  chatter::ListenOptions options;
  std::optional<chatter::SpeedRange> machine;
};

void read_sound_range(Reader& r, ListenRequest& q) {
  const Bounds band = within(1, 2e5, "Hz");
  q.options.from_Hz = r.number_or("from_Hz", band, q.options.from_Hz);
  q.options.to_Hz = r.optional_number("to_Hz", band);
  if (q.options.to_Hz && *q.options.to_Hz <= q.options.from_Hz)
    r.problem_at("to_Hz", tr("a frequency above from_Hz"), "range");
  auto found = r.find("machine_rpm");
  if (!found) return;
  Reader machine = found->as_object();
  const Bounds speed = within(1, 1e6, "1/min");
  q.machine =
      chatter::SpeedRange{machine.number("from", speed), machine.number("to", speed)};
  if (q.machine->from_rpm > q.machine->to_rpm)
    machine.problem_at("to", tr("a speed not below from"), "range");
  machine.finish();
}

/// Checks "stability", the chart of the cut that was heard.
void read_chart(Reader& r, const json& request, const Catalogue& catalogue,
                Problems& problems) {
  if (auto chart = r.find("stability"))
    read_below(*chart, problems,
               [&] { stability_request::read(request.at("stability"), catalogue); });
}

ListenRequest read_listen_request(const json& request, const Catalogue& catalogue) {
  Problems problems{.document = "listen"};
  ListenRequest q;
  Reader r = Reader(request, problems).as_object();
  read_format(r, "turnwright-listen/1");
  if (!r.broken()) {
    const Reader wav = r.at("wav", tr("the bytes of a .wav file in base64"));
    if (!wav.broken()) {
      const std::string bytes = read_base64(wav, to_translate("sound"), kLargestSound);
      if (!bytes.empty()) q.wav = read_wav(wav, bytes);
    }
    q.channel = static_cast<std::size_t>(r.integer_or("channel", 1, 2, 1)) - 1;
    if (!q.wav.channels.empty() && q.channel >= q.wav.channels.size())
      r.problem_at("channel", tr("1, as the sound has one channel"), "range");
    q.options.n_rpm = r.number("n_rpm", within(1, 1e6, "1/min"));
    q.options.teeth = static_cast<int>(r.integer_or("teeth", 1, 100, 1));
    read_sound_range(r, q);
    read_chart(r, request, catalogue, problems);
    r.finish();
  }
  problems.throw_if_any();
  return q;
}

ordered_json described(const chatter::SoundLine& line) {
  return {{"frequency_Hz", line.frequency_Hz},
          {"amplitude", line.amplitude},
          {"over_noise_dB", line.over_noise_dB}};
}

void add_lines(const ListenRequest& q, const chatter::Heard& heard, ordered_json& out) {
  out["harmonics"] = ordered_json::array();
  for (const auto& [line, order] : heard.harmonics) {
    ordered_json told = described(line);
    told["order"] = order;
    told["of_teeth"] = order % q.options.teeth == 0;
    out["harmonics"].push_back(std::move(told));
  }
  out["others"] = ordered_json::array();
  for (const auto& line : heard.others) out["others"].push_back(described(line));
}

ordered_json steady(const ListenRequest& q, const chatter::Heard& heard) {
  ordered_json out = ordered_json::array();
  for (const auto& [n_rpm, harmonic] :
       chatter::steady_speeds(heard.chatter->frequency_Hz, heard.n_rpm, q.options.teeth))
    if (!q.machine || q.machine->holds(n_rpm))
      out.push_back({{"n_rpm", n_rpm}, {"harmonic", harmonic}});
  return out;
}

}  // namespace

ordered_json listen(const json& request, const Catalogue& catalogue,
                    const std::stop_token& stop) {
  const ListenRequest q = read_listen_request(request, catalogue);
  const auto& samples = q.wav.channels[q.channel];
  leave_if(stop);
  const auto heard = chatter::listen({q.wav.rate_Hz, samples}, q.options);
  ordered_json out{{"format", "turnwright-listen-result/1"}};
  out["sound"] = {{"rate_Hz", q.wav.rate_Hz},
                  {"seconds", static_cast<double>(samples.size()) / q.wav.rate_Hz},
                  {"channels", q.wav.channels.size()},
                  {"bits", q.wav.bits}};
  out["taken"] = {{"n_rpm", q.options.n_rpm}, {"teeth", q.options.teeth}};
  out["n_rpm"] = heard.n_rpm;
  out["resolution_Hz"] = heard.resolution_Hz;
  out["from_Hz"] = heard.from_Hz;
  out["to_Hz"] = heard.to_Hz;
  out["chatter"] = heard.chatter ? described(*heard.chatter) : ordered_json();
  if (heard.chatter) out["speeds"] = steady(q, heard);
  add_lines(q, heard, out);
  if (request.contains("stability")) {
    const json chart = stability(request.at("stability"), catalogue, stop);
    for (const char* key : {"best", "points", "undecided"})
      if (chart.contains(key)) out["stability"][key] = chart.at(key);
  }
  return out;
}

std::string sound_base64(const std::string& bytes) { return base64_of(bytes); }

}  // namespace turnwright::document
