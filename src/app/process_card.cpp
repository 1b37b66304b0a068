#include "process_card.hpp"

#include <unistd.h>
#include <xlsxwriter.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>

#include "base/say.hpp"
#include "service/output.hpp"

namespace turnwright::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

// libxlsxwriter writes to a name, not to memory.
class Scratch {
 public:
  Scratch() : name_((fs::temp_directory_path() / "turnwright-XXXXXX").string()) {
    const int descriptor = mkstemp(name_.data());
    if (descriptor < 0) fail(std::strerror(errno));
    close(descriptor);
  }
  ~Scratch() {
    std::error_code gone;
    fs::remove(name_, gone);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const std::string& name() const { return name_; }
  [[noreturn]] void fail(const std::string& why) const {
    throw service::OutputError(say("{}: cannot be written: {}", name_, why));
  }

 private:
  std::string name_;
};

struct Column {
  const char* heading;
  double width;  // characters
  const char* pointer;
};

constexpr std::array kPrices{
    Column{to_translate("Part"), 24, "/part"},
    Column{to_translate("Made by"), 36, "/made_by"},
    Column{to_translate("Batch"), 8, "/batch"},
    Column{to_translate("Price"), 10, "/price"},
    Column{to_translate("Stock"), 10, "/stock"},
    Column{to_translate("Run"), 10, "/run"},
    Column{to_translate("Setting up"), 10, "/setting_up"},
    Column{to_translate("Scrap"), 10, "/scrap"},
    Column{to_translate("Overhead"), 10, "/overhead"},
    Column{to_translate("Margin"), 10, "/margin"},
    Column{to_translate("Minutes"), 10, "/time_min"},
    Column{to_translate("Least cost proved"), 18, "/lower_bound"}};
constexpr std::array kRouting{Column{to_translate("Part"), 24, "/part"},
                              Column{to_translate("Made by"), 36, "/made_by"},
                              Column{to_translate("Operation"), 10, "/operation"},
                              Column{to_translate("Machine"), 16, "/machine"},
                              Column{to_translate("Description"), 44, "/description"},
                              Column{to_translate("Setting up, min"), 16, "/setup_min"},
                              Column{to_translate("Run, min"), 10, "/run_min"}};
constexpr std::array kWays{Column{to_translate("Part"), 24, "/part"},
                           Column{to_translate("Made by"), 36, "/made_by"},
                           Column{to_translate("Proved"), 8, "/proved"},
                           Column{to_translate("Stock, kg"), 10, "/stock_kg"},
                           Column{to_translate("Conforming"), 12, "/conforming"},
                           Column{to_translate("Energy, kWh"), 12, "/energy/kWh"},
                           Column{to_translate("CO2, kg"), 10, "/energy/kg_CO2"}};

// The rows of one list of every part, each with the name of its part.
ordered_json rows_of(const ordered_json& quote, const char* list) {
  auto rows = ordered_json::array();
  for (const auto& part : quote["parts"])
    for (auto row : part[list]) {
      row["part"] = part["name"];
      rows.push_back(std::move(row));
    }
  return rows;
}

class Card {
 public:
  Card(const Scratch& file, const std::string& currency)
      : file_(file), book_(workbook_new(file.name().c_str()), lxw_workbook_free) {
    if (!book_) file.fail(tr("no memory"));
    lxw_doc_properties about{};
    auto title = currency.empty() ? tr("Process card")
                                  : say("Process card, prices in {}", currency);
    about.title = title.data();
    about.created = 1;  // not the clock's: equal quotes are equal files
    workbook_set_properties(book_.get(), &about);
    bold_ = workbook_add_format(book_.get());
    format_set_bold(bold_);
    number_ = workbook_add_format(book_.get());
    format_set_num_format(number_, "0.000");
  }
  Card(const Card&) = delete;
  Card& operator=(const Card&) = delete;

  void add_sheet(const std::string& name, std::span<const Column> columns,
                 const ordered_json& rows) {
    auto* sheet = workbook_add_worksheet(book_.get(), name.c_str());
    worksheet_freeze_panes(sheet, 1, 0);
    lxw_col_t at = 0;
    for (const auto& column : columns) {
      worksheet_set_column(sheet, at, at, column.width, nullptr);
      worksheet_write_string(sheet, 0, at, tr(column.heading).c_str(), bold_);
      lxw_row_t row = 0;
      for (const auto& values : rows) put(sheet, ++row, at, values, column.pointer);
      ++at;
    }
  }

  void close() {
    if (const auto error = workbook_close(book_.release()); error != LXW_NO_ERROR)
      file_.fail(lxw_strerror(error));
  }

 private:
  // A cell stays empty where a row has no such member.
  void put(lxw_worksheet* sheet, lxw_row_t row, lxw_col_t column,
           const ordered_json& values, const char* pointer) const {
    const ordered_json::json_pointer at(pointer);
    if (!values.contains(at)) return;
    const auto& value = values.at(at);
    if (value.is_string())
      worksheet_write_string(sheet, row, column,
                             value.get_ref<const std::string&>().c_str(), nullptr);
    else if (value.is_boolean())
      worksheet_write_boolean(sheet, row, column, value.get<bool>() ? 1 : 0, nullptr);
    else
      worksheet_write_number(sheet, row, column, value.get<double>(),
                             value.is_number_integer() ? nullptr : number_);
  }

  const Scratch& file_;
  std::unique_ptr<lxw_workbook, decltype(&lxw_workbook_free)> book_;
  lxw_format *bold_ = nullptr, *number_ = nullptr;
};

}  // namespace

std::string process_card(const ordered_json& quote) {
  const Scratch file;
  Card card(file, quote.value("currency", ""));
  card.add_sheet(tr("Prices"), kPrices, rows_of(quote, "prices"));
  card.add_sheet(tr("Routing"), kRouting, quote["routing"]);
  card.add_sheet(tr("Ways"), kWays, rows_of(quote, "ways"));
  card.close();
  std::ifstream in(file.name(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace turnwright::app
