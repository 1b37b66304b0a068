// Results in QIF 3.0, written here after the schemas of the standard.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <stop_token>

#include "../slips.hpp"
#include "document/json/file.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/document/learn.hpp"

namespace turnwright::document::learn_qif_test {
namespace {

using nlohmann::json;

const Catalogue& catalogue() {
  static const Catalogue kCatalogue = load_catalogue(source_path(""));
  return kCatalogue;
}

json learned(const json& request) {
  static const SchemaCheck kRequest("learn.request.json"), kResult("learn.result.json");
  EXPECT_EQ(kRequest.fault(request), "");
  json result = learn(request, catalogue());
  EXPECT_EQ(kResult.fault(result), "") << result;
  return result;
}

std::string refused(const json& request) {
  return input_refusal([](const json& r) { learn(r, catalogue()); }, request);
}

std::string text_of_file(const std::string& name) {
  std::ifstream in(source_path(name));
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A document of one diameter of nine parts, pieces of which tests replace.
struct Document {
  std::string root = "<QIFDocument xmlns=\"http://qifstandards.org/xsd/qif3\">";
  std::string units =
      "<FileUnits><PrimaryUnits><LinearUnit><UnitName>mm</UnitName><UnitConversion>"
      "<Factor>0.001</Factor></UnitConversion></LinearUnit></PrimaryUnits></FileUnits>";
  std::string tolerance =
      "<MaxValue>0.02</MaxValue><MinValue>-0.02</MinValue>"
      "<DefinedAsLimit>false</DefinedAsLimit>";
  std::string target = "<TargetValue>30</TargetValue>";
  std::string item = "<Name>seat</Name>";
  std::string kind = "Diameter", status = "PASS", attribute, extra, device;
  /// Of the k-th part: its value and what else stands in its measurement.
  std::function<std::string(int)> value = [](int k) {
    return fmt::format("{:.4f}", 30 + 0.001 * (k % 3));
  };
  std::function<std::string(int)> stamp = [](int) { return std::string(); };
  std::function<std::string(int)> serial = [](int k) { return fmt::format("S{}", k); };
  int parts = 9;

  std::string text() const {
    std::string all = "<?xml version=\"1.0\"?>\n" + root + "\n" + units;
    all += "<MeasurementResources><MeasurementDevices>" + device +
           "</MeasurementDevices></MeasurementResources>\n";
    all += fmt::format(
        "<Characteristics><CharacteristicDefinitions>"
        "<{0}CharacteristicDefinition id=\"1\"><Tolerance>{1}</Tolerance>"
        "</{0}CharacteristicDefinition></CharacteristicDefinitions>\n"
        "<CharacteristicNominals><{0}CharacteristicNominal id=\"2\">"
        "<CharacteristicDefinitionId>1</CharacteristicDefinitionId>{2}"
        "</{0}CharacteristicNominal></CharacteristicNominals>\n"
        "<CharacteristicItems><{0}CharacteristicItem id=\"3\">{3}"
        "<CharacteristicNominalId>2</CharacteristicNominalId>"
        "</{0}CharacteristicItem></CharacteristicItems></Characteristics>\n"
        "<Results><MeasurementResultsSet>\n",
        kind, tolerance, target, item);
    for (int k = 1; k <= parts; ++k)
      all += fmt::format(
          "<MeasurementResults id=\"{0}\"><MeasuredCharacteristics>"
          "<CharacteristicMeasurements><{1}CharacteristicMeasurement id=\"{2}\">"
          "<Status><CharacteristicStatusEnum>{3}</CharacteristicStatusEnum></Status>"
          "<CharacteristicItemId>3</CharacteristicItemId>{4}<Value {5}>{6}</Value>"
          "</{1}CharacteristicMeasurement>{7}</CharacteristicMeasurements>"
          "</MeasuredCharacteristics><ActualComponentIds><Id>{8}</Id>"
          "</ActualComponentIds></MeasurementResults>\n",
          100 + k, kind, 200 + k, status, stamp(k), attribute, value(k), extra, 300 + k);
    all += "</MeasurementResultsSet><ActualComponentSets><ActualComponentSet>\n";
    for (int k = 1; k <= parts; ++k)
      all += fmt::format(
          "<ActualComponent id=\"{}\">{}</ActualComponent>\n", 300 + k,
          serial(k).empty() ? "" : "<SerialNumber>" + serial(k) + "</SerialNumber>");
    return all + "</ActualComponentSet></ActualComponentSets></Results></QIFDocument>\n";
  }
};

json request_of(const Document& d) { return {{"qif", {{"files", {d.text()}}}}}; }

json of_seat(const Document& d) {
  return learned(request_of(d))["characteristics"].at(0);
}

double mean_mm(const Document& d) { return of_seat(d)["mean_mm"]["value"]; }
// Of 30, 30.001 and 30.002 mm three times each.
constexpr double kMean_mm = 30.001;

// The table of the pins and the same values in QIF: every number is the same.
TEST(LearnQif, GivesTheAnswersOfTheSameTable) {
  json table{{"part", parse_file(source_path("docs/examples/guide/pin.json"))}};
  auto qif = table;
  table["csv"] = text_of_file("docs/examples/learn/pin.csv");
  qif["qif"]["files"] = {text_of_file("docs/examples/learn/pin.qif")};
  const auto a = learned(table)["characteristics"], b = learned(qif)["characteristics"];
  ASSERT_EQ(a.size(), 2U);
  ASSERT_EQ(b.size(), 2U);
  for (const auto& x : a)
    for (const auto& y : b) {
      if (x["id"] != y["id"]) continue;
      EXPECT_EQ(x["n"], y["n"]);
      EXPECT_EQ(x["left_out"], y["left_out"]);
      for (const char* place : {"/mean_mm/value", "/mean_mm/u", "/drift_mm_h/value",
                                "/wear_mm_part/value", "/edges/between_mm"})
        if (x.contains(json::json_pointer(place))) {
          const double u = x[json::json_pointer(place)], v = y[json::json_pointer(place)];
          EXPECT_NEAR(v, u, 1e-9 * std::abs(u) + 1e-15) << x["id"] << place;
        }
    }
  EXPECT_EQ(b[0]["device"] == "Micrometer 0-25" || b[1]["device"] == "Micrometer 0-25",
            true);
}

TEST(LearnQif, HearsThatNobodyWaits) {
  std::stop_source source;
  source.request_stop();
  const std::stop_token token = source.get_token();
  const json request = request_of({});
  (void)catalogue();  // loading it is not what hears
  const Listening listening(token);
  EXPECT_THROW(learn(request, catalogue()), Cancelled);
}

// Each value and limit in its unit: that of its attribute, the file's, or metres.
TEST(LearnQif, KnowsTheUnitOfEachValue) {
  EXPECT_NEAR(mean_mm({}), kMean_mm, 1e-12);
  const auto scaled = [](double by) {
    return [by](int k) { return fmt::format("{:.9f}", (30 + 0.001 * (k % 3)) * by); };
  };
  Document metres;
  metres.units = "";
  metres.value = scaled(1e-3);
  metres.target = "<TargetValue>0.03</TargetValue>";
  metres.tolerance = "<MaxValue>0.00002</MaxValue><MinValue>-0.00002</MinValue>";
  const auto m = of_seat(metres);
  EXPECT_NEAR(m["mean_mm"]["value"], kMean_mm, 1e-6);
  EXPECT_NEAR(m["upper_mm"], 30.02, 1e-9);
  Document inches;
  inches.value = scaled(1 / 25.4);
  inches.attribute = "linearUnit=\"inch\"";
  inches.units.insert(
      inches.units.find("</FileUnits>"),
      "<OtherUnits><LinearUnit><UnitName>inch</UnitName><UnitConversion>"
      "<Factor>0.0254</Factor></UnitConversion></LinearUnit></OtherUnits>");
  EXPECT_NEAR(mean_mm(inches), kMean_mm, 1e-6);
  // S = (X + offset) factor.
  Document shifted;
  shifted.units.insert(shifted.units.find("</UnitConversion>"), "<Offset>1</Offset>");
  shifted.value = [](int k) { return fmt::format("{:.4f}", 29 + 0.001 * (k % 3)); };
  EXPECT_NEAR(mean_mm(shifted), kMean_mm, 1e-9);
  inches.attribute = "linearUnit=\"span\"";
  EXPECT_NE(refused(request_of(inches)).find("a linear unit that FileUnits defines"),
            std::string::npos);
}

TEST(LearnQif, TakesLimitsAsTheFileWritesThem) {
  const auto both = of_seat({});
  EXPECT_NEAR(both["nominal_mm"], 30, 1e-9);
  EXPECT_NEAR(both["upper_mm"], 30.02, 1e-9);
  EXPECT_NEAR(both["lower_mm"], 29.98, 1e-9);
  Document limits;
  limits.tolerance =
      "<MaxValue>30.03</MaxValue><MinValue>29.99</MinValue>"
      "<DefinedAsLimit>true</DefinedAsLimit>";
  limits.target = "";
  const auto middle = of_seat(limits);
  EXPECT_NEAR(middle["nominal_mm"], 30.01, 1e-9);
  EXPECT_NEAR(middle["upper_mm"], 30.03, 1e-9);
  // Those of the request go before those of the file.
  auto request = request_of({});
  request["characteristics"] = {
      {{"id", "bore"}, {"nominal_mm", 30}, {"upper_mm", 30.05}, {"lower_mm", 29.9}}};
  request["qif"]["names"] = {{{"name", "seat"}, {"id", "bore"}}};
  const auto named = learned(request)["characteristics"].at(0);
  EXPECT_EQ(named["id"], "bore");
  EXPECT_NEAR(named["upper_mm"], 30.05, 1e-12);
  // A form has one limit, and its values are no sizes.
  Document form;
  form.kind = "Circularity";
  form.tolerance = "";
  form.value = [](int k) { return fmt::format("{:.4f}", 0.002 + 0.001 * (k % 3)); };
  auto text = form.text();
  text.replace(text.find("<Tolerance></Tolerance>"), 23,
               "<ToleranceValue>0.01</ToleranceValue>");
  const auto circularity =
      learned({{"qif", {{"files", {text}}}}})["characteristics"].at(0);
  EXPECT_FALSE(circularity.contains("lower_mm"));
  EXPECT_NEAR(circularity["upper_mm"], 0.01, 1e-12);
}

TEST(LearnQif, ReadsAnyPrefixOfTheNamespaceAndNoOther) {
  Document prefixed;
  auto text = prefixed.text();
  for (std::size_t at = 0; (at = text.find('<', at)) != text.npos; ++at) {
    const auto name = at + (text[at + 1] == '/' ? 2 : 1);
    if (std::isalpha(static_cast<unsigned char>(text[name]))) text.insert(name, "q:");
  }
  text.replace(text.find("xmlns="), 6, "xmlns:q=");
  const auto c = learned({{"qif", {{"files", {text}}}}})["characteristics"].at(0);
  EXPECT_EQ(c["n"], 9);
  Document two;
  two.root = "<QIFDocument xmlns=\"http://qifstandards.org/xsd/qif2\">";
  EXPECT_EQ(refused(request_of(two))
                .find("/qif/files/0#line 2: got QIFDocument of "
                      "\"http://qifstandards.org/xsd/qif2\""),
            refused(request_of(two)).find("/qif"));
}

// Parts are in the order of their times, which tell drift; half of them tell nothing.
TEST(LearnQif, KnowsTimesWithZones) {
  Document timed;
  timed.stamp = [](int k) {
    const char* zones[] = {"Z", "+02:00", "-01:30"};
    const int minutes = 600 + 10 * k + (k % 3 == 1 ? 120 : k % 3 == 2 ? -90 : 0);
    return fmt::format("<TimeStamp>2026-03-02T{:02}:{:02}:00.5{}</TimeStamp>",
                       minutes / 60, minutes % 60, zones[k % 3]);
  };
  // 1 um in each 10 min: 6 um/h.
  timed.value = [](int k) {
    return fmt::format("{:.5f}", 30 + 0.001 * k + (k % 2 ? 1e-4 : -1e-4));
  };
  const auto c = of_seat(timed);
  EXPECT_NEAR(c["drift_mm_h"]["value"], 6e-3, 2e-4);
  const auto warnings = learned(request_of(timed))["warnings"].dump();
  EXPECT_NE(warnings.find("times are those of measuring"), std::string::npos);
  auto half = timed;
  half.stamp = [&](int k) { return k % 2 ? timed.stamp(k) : std::string(); };
  EXPECT_FALSE(of_seat(half).contains("drift_mm_h"));
  timed.stamp = [](int) {
    return std::string("<TimeStamp>2026-02-30T10:00:00</TimeStamp>");
  };
  EXPECT_NE(refused(request_of(timed)).find("got 2026-02-30T10:00:00, expected a date"),
            std::string::npos);
}

TEST(LearnQif, TellsPartsWithoutASerialNumber) {
  Document d;
  d.serial = [](int) { return std::string(); };
  const auto values = of_seat(d)["values"];
  EXPECT_EQ(values.at(0)["part"], "1");
  EXPECT_EQ(values.at(8)["part"], "9");
  // The second file goes on counting.
  const auto c = learned({{"qif", {{"files", {d.text(), d.text()}}}}});
  EXPECT_EQ(c["characteristics"].at(0)["values"].at(17)["part"], "18");
}

// Two items of one balloon are two characteristics.
TEST(LearnQif, TellsItemsOfOneNameApart) {
  auto text = Document().text();
  text.insert(text.find("</CharacteristicItems>"),
              "<DiameterCharacteristicItem id=\"4\"><Name>seat</Name>"
              "<CharacteristicNominalId>2</CharacteristicNominalId>"
              "</DiameterCharacteristicItem>");
  EXPECT_EQ(learned({{"qif", {{"files", {text}}}}})["characteristics"].at(0)["id"],
            "seat (item 3)");
}

// The holes of a pattern have one item.
TEST(LearnQif, TellsRepeatedMeasurementsOfAnItemApart) {
  Document d;
  d.extra =
      "<DiameterCharacteristicMeasurement id=\"9\"><CharacteristicItemId>3"
      "</CharacteristicItemId><Value>30.01</Value></DiameterCharacteristicMeasurement>";
  const auto all = learned(request_of(d))["characteristics"];
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all.at(0)["id"], "seat");
  EXPECT_EQ(all.at(1)["id"], "seat #2");
  EXPECT_NEAR(all.at(1)["upper_mm"], 30.02, 1e-9);
  EXPECT_NEAR(all.at(0)["mean_mm"]["value"], kMean_mm, 1e-9);
}

// What is no length, was not analysed or has no limits is told and left.
TEST(LearnQif, TellsWhatItLeaves) {
  Document d;
  d.extra =
      "<AngleCharacteristicMeasurement id=\"9\"><CharacteristicItemId>3"
      "</CharacteristicItemId><Value>90</Value></AngleCharacteristicMeasurement>"
      "<DiameterCharacteristicMeasurement id=\"8\"><CharacteristicItemId>3"
      "</CharacteristicItemId><MaxValue>30</MaxValue></"
      "DiameterCharacteristicMeasurement>";
  const auto warnings = learned(request_of(d))["warnings"].dump();
  EXPECT_NE(warnings.find("QIF: Angle is no length that is learned from (9 left)"),
            std::string::npos)
      << warnings;
  EXPECT_NE(warnings.find("QIF: Diameter without a single value (9 left)"),
            std::string::npos);
  Document failed;
  failed.status = "SYSERROR";
  EXPECT_NE(refused(request_of(failed)).find("got no such values"), std::string::npos);
  Document open;
  open.tolerance = "<MaxValue>0.02</MaxValue>";
  EXPECT_NE(refused(request_of(open)).find("got no such values"), std::string::npos);
}

TEST(LearnQif, NamesTheDevice) {
  Document d;
  d.device =
      "<Micrometer id=\"7\"><Name>M25</Name></Micrometer>"
      "<MeasurementDevice id=\"8\"><Name>CMM</Name></MeasurementDevice>";
  d.item += "<MeasurementDeviceIds><Id>7</Id></MeasurementDeviceIds>";
  EXPECT_EQ(of_seat(d)["device"], "M25");
  d.stamp = [](int k) {
    return k == 1 ? std::string("<MeasurementDeviceIds><Id>8</Id></MeasurementDeviceIds>")
                  : std::string();
  };
  EXPECT_FALSE(of_seat(d).contains("device"));
  EXPECT_NE(learned(request_of(d))["warnings"].dump().find("measured by 2 devices"),
            std::string::npos);
}

struct Malformed {
  const char* what;
  std::string text, message;
};

TEST(LearnQif, RefusesBrokenFilesWithTheirPlace) {
  const auto good = Document().text();
  const auto with = [&](const std::string& from, const std::string& to) {
    auto text = good;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  const Malformed all[] = {
      {"cut off", good.substr(0, good.size() / 2), "expected XML (1.0), QIF 3.0"},
      {"no XML", "part,value\n1,2\n", "expected XML (1.0), QIF 3.0"},
      {"another root", "<a xmlns=\"http://qifstandards.org/xsd/qif3\"/>",
       "/qif/files/0#line 1: got a of"},
      {"no number", with("30.0010", "thirty"),
       "/qif/files/0#line 8: got thirty, expected a length of at most 1 km"},
      {"no finite number", with("30.0010", "1e400"), "#line 8: got 1e400"},
      {"too far", with("30.0010", "1e9"), "#line 8: got 1e9"},
      {"no item", with("<CharacteristicItemId>3", "<CharacteristicItemId>33"),
       "/qif/files/0#line 8: got characteristic item \"33\""},
      {"no factor", with("<Factor>0.001", "<Factor>0"),
       "/qif/files/0#line 3: got 0, expected a number > 0, metres of the unit"},
      {"twice", with("S2", "S1"), "got part \"S1\" twice"}};
  for (const auto& m : all) {
    const auto message = refused({{"qif", {{"files", {m.text}}}}});
    EXPECT_NE(message.find(m.message), std::string::npos) << m.what << ": " << message;
  }
  EXPECT_NE(refused({{"qif", {{"files", {good}}}}, {"rows", json::array()}})
                .find("one of rows, csv and qif"),
            std::string::npos);
  // An id that no list knows is a name of its own; one beside a list is a slip.
  auto renamed = request_of({});
  renamed["qif"]["names"] = {{{"name", "seat"}, {"id", "d2:diameter"}}};
  EXPECT_EQ(learned(renamed)["characteristics"].at(0)["id"], "d2:diameter");
  renamed["characteristics"] = {{{"id", "bore"}, {"nominal_mm", 30}, {"upper_mm", 31}}};
  EXPECT_NE(refused(renamed).find("/qif/names/0/id"), std::string::npos);
}

}  // namespace
}  // namespace turnwright::document::learn_qif_test
