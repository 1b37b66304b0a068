#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

/// Exchange files of ISO 10303-21 ("Part 21", the clear text encoding of STEP): the grammar
/// alone, without a word of any schema.
namespace turnwright::exchange {

class Exchange;
class Instance;
class Parameter;

/// Number of an instance: 123 of `#123=PLANE('',#122);`.
using Id = std::uint64_t;

/// "#123".
std::string name_of(Id id);

/// Kinds of a parameter: $ is omitted, * derived (its value follows from other attributes).
enum class ValueKind : std::uint8_t {
  omitted,
  derived,
  integer,
  real,
  text,
  enumeration,
  binary,
  reference,
  list,
  typed,  ///< LENGTH_MEASURE(3.)
};

/// A parameter as it is kept: 16 bytes, whatever it holds.  Texts are places in the file.
struct Value {
  explicit Value(ValueKind of = ValueKind::omitted, std::size_t n = 0)
      : kind(of), size(static_cast<std::uint32_t>(n)) {}
  ValueKind kind = ValueKind::omitted;
  std::uint32_t size = 0;  ///< bytes of a text, entries of a list
  union {
    std::int64_t integer = 0;
    double real;
    const char* at;       ///< of a text, an enumeration, a binary: between its marks
    std::uint64_t index;  ///< of an instance; of the first entry of a list
  };
};

/// A record as it is kept: its parameters are `size` values from `first` on.
struct RecordEntry {
  std::string_view name;
  std::uint32_t first = 0, size = 0;
};

/// An entity name with its parameters, `PLANE('',#122)`: an instance, or a part of a complex
/// one, or an entry of the header.  Points into the exchange, which must outlive it.
class Record {
 public:
  std::string_view name() const { return entry_->name; }
  std::size_t size() const { return entry_->size; }
  /// Parameter n, counted from 0 here and from 1 in messages.
  /// @throws InputError if there are fewer.
  Parameter operator[](std::size_t n) const;
  /// "#12 PLANE"; "FILE_NAME" of the header.
  std::string place() const;
  /// @throws InputError that this record has `got` where `expected` is wanted.
  [[noreturn]] void refuse(std::string got, std::string expected) const;

 private:
  friend class Exchange;
  friend class Instance;
  friend class Parameter;
  Record(const Exchange& exchange, const RecordEntry& entry, std::optional<Id> id)
      : exchange_(&exchange), entry_(&entry), id_(id) {}
  const Exchange* exchange_;
  const RecordEntry* entry_;
  std::optional<Id> id_;
};

/// One parameter, a list's entry or a typed value's content.  What it cannot be is refused
/// with its place: "#12 CIRCLE parameter 3: got a string, expected a number".
class Parameter {
 public:
  ValueKind kind() const { return value_->kind; }
  bool is(ValueKind kind) const { return value_->kind == kind; }
  /// Omitted or derived: the file gives no value.
  bool absent() const { return is(ValueKind::omitted) || is(ValueKind::derived); }

  std::int64_t integer() const;
  /// A real or an integer; the reader has refused what is not finite.
  double real() const;
  /// In UTF-8, whatever encoding the file uses.
  std::string text() const;
  /// "" if absent.
  std::string text_or_empty() const { return absent() ? std::string() : text(); }
  /// Likewise of a text that many instances may share, so that it is read again and again:
  /// nothing if it has more than 1000 bytes in the file.
  std::optional<std::string> short_text() const;
  /// The word between the dots of an enumeration.
  std::string_view word() const;
  /// .T. or .F.
  bool boolean() const;
  /// Hexadecimal digits between the quotes of a binary value.
  std::string_view binary() const;
  /// The instance that it refers to.
  Instance instance() const;
  Id id() const;

  /// Entries of a list.
  std::size_t size() const;
  Parameter operator[](std::size_t n) const;

  /// LENGTH_MEASURE of LENGTH_MEASURE(3.), and its 3.
  std::string_view type() const;
  Parameter inner() const;
  /// A number, whether typed (to any depth) or not.
  double measure() const;

  /// "#12 CIRCLE parameter 3".
  std::string place() const;
  /// The value in words: "a string", "#17 PLANE", "a list of 3".
  std::string shown() const;
  /// @throws InputError that this value came where `expected` is wanted.
  [[noreturn]] void refuse(std::string expected) const;

 private:
  friend class Record;
  Parameter(Record record, std::size_t number, const Value& value)
      : record_(record), number_(number), value_(&value) {}
  const Value& required(ValueKind kind, std::string_view expected) const;
  Record record_;
  std::size_t number_;
  const Value* value_;
};

/// #id with its record, or the records of a complex instance in the order of the file.
/// Points into the exchange, which must outlive it.
class Instance {
 public:
  Id id() const;
  std::size_t line() const;  ///< where it begins; counted on demand
  std::size_t records() const;
  Record record(std::size_t n) const;
  /// Whether a record has this name.
  bool is(std::string_view name) const { return find(name).has_value(); }
  std::optional<Record> find(std::string_view name) const;
  /// @throws InputError if no record has this name.
  Record as(std::string_view name) const;
  /// The name, those of a complex instance joined by "+".
  std::string name() const;
  /// The instances that refer to this one, in the order of the file, each once.
  std::vector<Instance> users() const;
  bool operator==(const Instance& o) const { return index_ == o.index_; }
  auto operator<=>(const Instance& o) const { return index_ <=> o.index_; }
  /// Place in the file's order of instances, from 0: to mark what has been visited.
  std::size_t index() const { return index_; }

 private:
  friend class Exchange;
  friend class Parameter;
  Instance(const Exchange& exchange, std::size_t index)
      : exchange_(&exchange), index_(index) {}
  const Exchange* exchange_;
  std::size_t index_;
};

/// A whole file.  It keeps places in the text instead of copies, so the text must outlive
/// it, and so must the exchange all that it hands out; it does not move or copy.
class Exchange {
 public:
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;

  /// A record of the header, FILE_NAME for instance.
  std::optional<Record> header(std::string_view name) const;
  std::size_t size() const { return instances_.size(); }
  Instance instance(std::size_t index) const { return {*this, index}; }
  std::optional<Instance> find(Id id) const;
  /// @throws InputError if there is none.
  Instance at(Id id) const;
  /// All instances with a record of this name, in the order of the file.
  std::vector<Instance> all(std::string_view name) const;

 private:
  friend class Record;
  friend class Parameter;
  friend class Instance;
  friend class Part21Reader;
  friend Exchange read_part21(std::string_view text);

  struct InstanceEntry {
    Id id = 0;
    std::uint32_t first = 0, size = 0;  ///< records
    std::uint32_t at = 0;               ///< in the text
  };
  explicit Exchange(std::string_view text);

  std::string_view text_;
  std::vector<Value> values_;
  std::vector<RecordEntry> records_;  ///< of the header first
  std::size_t header_records_ = 0;
  std::vector<InstanceEntry> instances_;  ///< in the order of the file
  // Indices of instances: in the order of their numbers, of each name, and those that
  // refer to instance i, which are users_[first_user_[i]] to users_[first_user_[i + 1]].
  std::vector<std::uint32_t> by_id_;
  std::unordered_map<std::string_view, std::vector<std::uint32_t>> by_name_;
  std::vector<std::uint32_t> users_, first_user_;
};

/// Reads an exchange file: all editions of ISO 10303-21, several DATA sections; ANCHOR and
/// REFERENCE sections and what follows END-ISO-10303-21 are passed over.  White space and comments may stand
/// between any two tokens, strings may run over lines.  Time and memory are proportional to
/// the length of the text (16 bytes a parameter, about three times the text in all).
///
/// The text must outlive the exchange.
/// Bounds: a text of less than 4 GB, lists in lists up to 64 deep, integers of 64 bits.
/// @throws InputError listing up to 100 problems, each with its line: what is no record, a
///         file that ends early, an ENDSEC that is missing, a number used twice, a reference
///         to an instance that the file does not hold, a number that is not finite.
Exchange read_part21(std::string_view text);

/// A string of Part 21, as between its quotes, in UTF-8: '' and \\, \S\ with the code page
/// of \P.\, \X\hh, \X2\hhhh..\X0\, \X4\hhhhhhhh..\X0\.  Bytes above 127, which the standard
/// does not allow, are taken as UTF-8 if they are such, else as ISO 8859-1.  What stands
/// for no character becomes U+FFFD.
std::string part21_text(std::string_view encoded);

}  // namespace turnwright::exchange
