#pragma once
#include <string>
#include <string_view>

/// What the designations of inserts and holders have in common.
namespace turnwright::catalogue {

/// The symbols of a designation one after the other; spaces may stand between them.
class Designation {
 public:
  /// `text` has to live as long; `function` is named by errors.
  Designation(const char* function, const std::string& text)
      : function_(function), text_(text) {}

  std::string_view take(std::size_t count);
  char take_one_of(std::string_view letters);
  int take_two_digits();
  bool digit_follows() const;
  bool point_follows() const;
  /// @throws std::domain_error naming the symbol taken last.
  [[noreturn]] void fail(const std::string& rule) const;

 private:
  const char* function_;
  const std::string& text_;
  std::size_t at_ = 0;
  int number_ = 0;
  std::string_view last_;
};

}  // namespace turnwright::catalogue
