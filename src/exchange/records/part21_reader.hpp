#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "part21_lexer.hpp"

namespace turnwright::exchange {

/// The grammar of Part 21: fills an exchange record by record and goes on behind a faulty
/// one, so that all faults are told at once.
class Part21Reader {
 public:
  explicit Part21Reader(Exchange& exchange) : x_(exchange), lex_(exchange.text_) {}
  /// @throws InputError with the faults.
  void read();

 private:
  /// A list or a typed value that has begun: where its entries stand in scratch_.
  struct Frame {
    std::size_t begin = 0;
    bool typed = false;
  };
  struct Fault {
    std::size_t at = 0;
    std::string got, expected;
  };

  void sections();
  /// Records of a section until ENDSEC, each read by `one`.
  template <class One>
  void records(const One& one, std::string_view section);
  bool ended_section(std::string_view section);
  void instance();
  void record();
  std::pair<std::uint32_t, std::uint32_t> parameters();
  bool opens();
  Value closed();
  Value value();

  void index_ids();
  void resolve();
  void index_users();
  /// f(value, instance) for every value, in the order of the file.
  template <class F>
  void each_value(const F& f);

  void fault(std::size_t at, std::string got, std::string expected);
  void throw_faults();

  Exchange& x_;
  Part21Lexer lex_;
  std::vector<Value> scratch_;  // entries of the lists that have begun
  std::vector<Frame> frames_;
  std::vector<Fault> faults_;
  std::size_t more_faults_ = 0;
};

}  // namespace turnwright::exchange
