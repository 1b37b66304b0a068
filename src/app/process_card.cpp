#include "process_card.hpp"

#include <fmt/format.h>
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
    throw service::OutputError(name_ + ": cannot be written: " + why);
  }

 private:
  std::string name_;
};

struct Column {
  const char* heading;
  double width;  // characters
  const char* pointer;
};

constexpr std::array kPrices{Column{"Part", 24, "/part"},
                             Column{"Made by", 36, "/made_by"},
                             Column{"Batch", 8, "/batch"},
                             Column{"Price", 10, "/price"},
                             Column{"Stock", 10, "/stock"},
                             Column{"Run", 10, "/run"},
                             Column{"Setting up", 10, "/setting_up"},
                             Column{"Scrap", 10, "/scrap"},
                             Column{"Overhead", 10, "/overhead"},
                             Column{"Margin", 10, "/margin"},
                             Column{"Minutes", 10, "/time_min"},
                             Column{"Least cost proved", 18, "/lower_bound"}};
constexpr std::array kRouting{Column{"Part", 24, "/part"},
                              Column{"Made by", 36, "/made_by"},
                              Column{"Operation", 10, "/operation"},
                              Column{"Machine", 16, "/machine"},
                              Column{"Description", 44, "/description"},
                              Column{"Setting up, min", 16, "/setup_min"},
                              Column{"Run, min", 10, "/run_min"}};
constexpr std::array kWays{Column{"Part", 24, "/part"},
                           Column{"Made by", 36, "/made_by"},
                           Column{"Proved", 8, "/proved"},
                           Column{"Stock, kg", 10, "/stock_kg"},
                           Column{"Conforming", 12, "/conforming"},
                           Column{"Energy, kWh", 12, "/energy/kWh"},
                           Column{"CO2, kg", 10, "/energy/kg_CO2"}};

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
    if (!book_) file.fail("no memory");
    lxw_doc_properties about{};
    std::string title = "Process card";
    if (!currency.empty()) title += ", prices in " + currency;
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

  void add_sheet(const char* name, std::span<const Column> columns,
                 const ordered_json& rows) {
    auto* sheet = workbook_add_worksheet(book_.get(), name);
    worksheet_freeze_panes(sheet, 1, 0);
    lxw_col_t at = 0;
    for (const auto& column : columns) {
      worksheet_set_column(sheet, at, at, column.width, nullptr);
      worksheet_write_string(sheet, 0, at, column.heading, bold_);
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
  card.add_sheet("Prices", kPrices, rows_of(quote, "prices"));
  card.add_sheet("Routing", kRouting, quote["routing"]);
  card.add_sheet("Ways", kWays, rows_of(quote, "ways"));
  card.close();
  std::ifstream in(file.name(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace turnwright::app
