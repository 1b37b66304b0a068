// Responses of known modes, written as other programs write them, come back.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <random>

#include "responses.hpp"

namespace turnwright::document::response_table_test {
namespace {

using namespace responses;

const std::vector<True> kTwo{{640, 0.03, 9000}, {880, 0.025, 16000}};

std::string text_of(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.12g", x);
  return text;
}

/// A table of the two modes: a header and lines made of frequency and response.
json table(const std::string& header,
           const std::function<std::string(double, Complex)>& line, int derivative = 0) {
  json out{header};
  for (double f = 500; f <= 1100; f += 12)
    out.push_back(line(f, response_of(kTwo, f, derivative)));
  return out;
}

std::string parts(double f, Complex y) {
  return text_of(f) + "," + text_of(y.real()) + "," + text_of(y.imag());
}

TEST(ResponseTable, PartsByTheirWordsInAnyUnit) {
  struct Named {
    const char *real, *imaginary;
    double mm;
    int derivative;
  };
  for (const Named& n :
       {Named{"Real [mm/N]", "Imag [mm/N]", 1, 0}, Named{"re (m/N)", "im (m/N)", 1e3, 0},
        Named{"Re(H1), \u00b5m/N", "Im(H1), \u00b5m/N", 1e-3, 0},
        Named{"H real in/lbf", "H imaginary in/lbf", 25.4 / 4.4482216152605, 0},
        Named{"Realteil [m/s/N]", "Imagin\u00e4rteil [m/s/N]", 1e3, 1},
        Named{"real_m/s\u00b2/N", "imag_m/s\u00b2/N", 1e3, 2},
        Named{"Real (m/s^2)/N", "Imaginary", 1e3, 2},
        Named{"Real part [g/N]", "Imaginary part [g/N]", 9806.65, 2}}) {
    SCOPED_TRACE(n.real);
    const std::string header =
        std::string("Frequency [Hz],\"") + n.real + "\",\"" + n.imaginary + "\",remark";
    const json r =
        told({{"csv",
               table(
                   header, [&](double f, Complex y) { return parts(f, y / n.mm) + ",x"; },
                   n.derivative)}});
    expect_modes(r, kTwo, 1e-6);
    EXPECT_EQ(r["quantity"], n.derivative == 0   ? "receptance"
                             : n.derivative == 1 ? "mobility"
                                                 : "accelerance");
    EXPECT_EQ(r["convention"], "e^(+i w t)");
    EXPECT_FALSE(r.contains("coherence"));
  }
}

TEST(ResponseTable, MagnitudeAndPhase) {
  const auto deg = [](Complex y) { return std::arg(y) * 180 / M_PI; };
  const auto dB = [](double ratio) { return 20 * std::log10(ratio); };
  expect_modes(told({{"csv", table("f [Hz]\tMag [um/N]\tPhase [deg]",
                                   [&](double f, Complex y) {
                                     return text_of(f) + "\t" + text_of(1e3 * abs(y)) +
                                            "\t" + text_of(deg(y));
                                   })}}),
               kTwo, 1e-6);
  expect_modes(  // unwrapped, in rad and kHz
      told({{"csv", table("Freq (kHz),Amplitude (m/N),Angle (rad)",
                          [&](double f, Complex y) {
                            return text_of(f / 1000) + "," + text_of(abs(y) / 1e3) + "," +
                                   text_of(std::arg(y) + 4 * M_PI);
                          })}}),
      kTwo, 1e-6);
  for (const auto& [unit, reference] :
       {std::pair("dB re 1 m/N", 1e3), {"dB (mm/N)", 1.0}, {"dB re 1e-6 m/N", 1e-3}}) {
    SCOPED_TRACE(unit);
    expect_modes(
        told({{"csv", table(std::string("Frequency,Magnitude [") + unit + "],Phase [deg]",
                            [&](double f, Complex y) {
                              return text_of(f) + "," + text_of(dB(abs(y) / reference)) +
                                     "," + text_of(deg(y));
                            })}}),
        kTwo, 1e-6);
  }
  expect_modes(  // the units are those of the request
      told({{"unit", "um/N"},
            {"phase_unit", "rad"},
            {"columns", {{"magnitude", "|H|"}}},
            {"csv", table("frequency,|H|,phase",
                          [&](double f, Complex y) {
                            return text_of(f) + "," + text_of(1e3 * abs(y)) + "," +
                                   text_of(std::arg(y));
                          })}}),
      kTwo, 1e-6);
}

TEST(ResponseTable, ALineOfUnitsBelowTheHeader) {
  json csv = table("frequency;magnitude;phase", [&](double f, Complex y) {
    return text_of(2 * M_PI * f) + ";" + text_of(abs(y) / 1e3) + ";" +
           text_of(std::arg(y) * 180 / M_PI);
  });
  csv.insert(csv.begin() + 1, "[rad/s];[m/N];\u00b0");
  expect_modes(told({{"csv", csv}}), kTwo, 1e-6);
}

TEST(ResponseTable, DecimalCommasBehindSemicolonsOrTabs) {
  for (const char* separator : {";", "\t"}) {
    json csv = table("f [Hz],Re [um/N],Im [um/N]",
                     [](double f, Complex y) { return parts(f, 1e3 * y); });
    for (json& line : csv) {
      auto text = line.get<std::string>();
      for (std::size_t at = 0; (at = text.find(',', at)) != text.npos; ++at)
        text.replace(at, 1, separator);
      if (line != csv[0])
        for (std::size_t at = 0; (at = text.find('.', at)) != text.npos; ++at)
          text[at] = ',';
      line = text;
    }
    expect_modes(told({{"csv", csv}}), kTwo, 1e-6);
  }
}

// The other sign of phase is that of a force e^(-i w t); the opposite sign of the motion,
// which leads to a positive imaginary part too, is not taken for it.
TEST(ResponseTable, TheSignOfPhaseIsRecognised) {
  std::mt19937_64 bits(1);
  std::normal_distribution<double> error(0, 1e-6);
  for (const int derivative : {0, 1, 2})
    for (const bool noisy : {false, true}) {
      SCOPED_TRACE(testing::Message() << derivative << noisy);
      const auto with = [&](const std::function<Complex(Complex)>& change) {
        return json{{"unit", derivative == 0   ? "mm/N"
                             : derivative == 1 ? "mm/s/N"
                                               : "mm/s2/N"},
                    {"csv", table(
                                "f,re,im",
                                [&](double f, Complex y) {
                                  const Complex noise(error(bits), error(bits));
                                  const double size =
                                      std::pow(2 * M_PI * 700, derivative);
                                  return parts(f, change(y + (noisy ? size : 0) * noise));
                                },
                                derivative)}};
      };
      const json asked = with([](Complex y) { return std::conj(y); });
      const json r = told(asked);
      EXPECT_EQ(r["convention"], "e^(-i w t)");
      expect_modes(r, kTwo, noisy ? 0.05 : 1e-6);
      const auto warnings = answer(request(asked))["warnings"].dump();
      EXPECT_NE(warnings.find("/frf/0/csv: its phase is that under a force e^(-i w t)"),
                std::string::npos);
      json opposite = with([](Complex y) { return -y; });
      EXPECT_NE(refused(opposite), "");
      opposite["reversed"] = true;
      expect_modes(told(opposite), kTwo, noisy ? 0.05 : 1e-6);
    }
}

// Below 600 Hz a second source shakes the tool: without coherence the fit is spoilt.
TEST(ResponseTable, LinesOfLowCoherenceWeighLess) {
  std::mt19937_64 bits(2);
  std::normal_distribution<double> unit(0, 1);
  const auto lines = [&](const char* header, bool coherence) {
    bits.seed(2);
    return table(header, [&](double f, Complex y) {
      const double g = f < 600 ? 0.2 : 0.9999;
      const double size = std::abs(y) * std::sqrt((1 - g) / g / 2);
      const Complex now = y + Complex(size * unit(bits), size * unit(bits));
      return parts(f, now) + (coherence ? "," + text_of(100 * g) : "");
    });
  };
  const json with = told({{"csv", lines("f,re [mm/N],im [mm/N],Coherence [%]", true)}});
  expect_modes(with, kTwo, 0.03);
  EXPECT_DOUBLE_EQ(with["coherence"]["least"], 0.2);
  EXPECT_DOUBLE_EQ(with["coherence"]["at_Hz"], 500);
  const json without = told({{"csv", lines("f,re [mm/N],im [mm/N]", false)}});
  const auto off = [](const json& r) {
    double out = 0;
    for (std::size_t i = 0; i < 2 && i < r["modes"].size(); ++i)
      out += std::abs(r["modes"][i]["stiffness_N_mm"].get<double>() / kTwo[i].k_N_mm - 1);
    return out;
  };
  EXPECT_GT(off(without), 4 * off(with));
}

TEST(ResponseTable, LowCoherenceAtAModeIsTold) {
  const json asked{
      {"csv", table("f,re [mm/N],im [mm/N],coherence", [&](double f, Complex y) {
         const double g = f < 520 ? 0.05 : f > 800 ? 0.7 : 1;
         return parts(f, y) + "," + text_of(g);
       })}};
  const json r = answer(request(asked));
  EXPECT_EQ(r["frf"][0]["left_out"], 2);  // 500 and 512 Hz
  const auto warnings = r["warnings"].dump();
  EXPECT_NE(warnings.find("#line 34: a coherence of 0.7 at the mode of 880 Hz"),
            std::string::npos)
      << warnings;
  EXPECT_EQ(warnings.find("at the mode of 640"), std::string::npos);
}

TEST(ResponseTable, EveryMistakeIsToldWithLineAndColumn) {
  EXPECT_EQ(
      refused({{"csv",
                {"Frequency [Hz];Mag [mm/N];Phase [grad];Coherence [dB]",
                 "100;0,001;-10;0,9", "90;-0,001;-20;1,2", "110;0.001;-30;0,9",
                 "120;1,5x;;0,9", "130;0,1", "\"a;0,1;2;0,9", "2e6;1e13;2;0,9"}}}),
      R"(stability: /frf/0/csv#line 4/Mag [mm~1N]: got "0.001", expected a decimal comma, here and in all numbers
stability: /frf/0/csv#line 5/Mag [mm~1N]: got "1,5x", expected a number from -1000000000000 to 1000000000000
stability: /frf/0/csv#line 5/Phase [grad]: got nothing, expected a number from -1000000000000 to 1000000000000
stability: /frf/0/csv#line 6: got 2 cells, expected 4 as in the header
stability: /frf/0/csv#line 7: got a quote out of place, expected cells as "text", on one line, with "" for a quote
stability: /frf/0/csv#line 8/Mag [mm~1N]: got "1e13", expected a number from -1000000000000 to 1000000000000
stability: /frf/0/csv#line 1/Phase [grad]: got "grad", expected a unit of phase: deg or rad
stability: /frf/0/csv#line 1/Coherence [dB]: got "dB", expected a unit of coherence: none or %
stability: /frf/0/csv#line 3/Frequency [Hz]: got 90, expected more than 100 Hz of the line before
stability: /frf/0/csv#line 3/Mag [mm~1N]: got -0.001, expected a number >= 0
stability: /frf/0/csv#line 3/Coherence [dB]: got 1.2, expected a number from 0 to 1
stability: /frf/0/csv#line 8/Frequency [Hz]: got 2000000, expected a number from 0 to 1000000 Hz)");
}

TEST(ResponseTable, UnitsAloneAreNoRows) {
  const std::string none =
      "stability: /frf/0/csv: got no rows below those of names and units, expected a "
      "header and 1 "
      "to "
      "20000 rows";
  EXPECT_EQ(refused({{"csv", {"f,Re,Im", "Hz,m/N,m/N"}}}), none);
  EXPECT_EQ(refused({{"csv", {"x", "%", "", ","}}}), none);
}

TEST(ResponseTable, HeadersThatDoNotTellEnough) {
  EXPECT_EQ(
      refused({{"csv", {"f,amp,phase", "1,2,3"}}}),
      R"(stability: /frf/0/unit: got nothing, expected a unit of motion per force here or in the header of the column
stability: /frf/0/phase_unit: got nothing, expected deg or rad, here or in the header of the phase)");
  EXPECT_EQ(refused({{"csv", {"f,amp,colour", "1,2,3"}}}),
            "stability: /frf/0/csv#line 1: got columns of frequency_Hz, magnitude, "
            "expected a frequency, and real and imaginary part, or magnitude and phase");
  EXPECT_EQ(
      refused({{"csv", {"f,Re x [m/N],Re y [m/N],Im [m/N]", "1,2,3,4"}}}),
      R"(stability: /frf/0/csv#line 1: got columns "Re x [m/N]" and "Re y [m/N]", expected one real, named under columns)");
  EXPECT_EQ(refused({{"columns", {{"phase", "arc"}, {"coherence", "Coh"}}},
                     {"csv", {"f,amp [m/N],arg [deg],coh", "1,2,3,4"}}}),
            R"(stability: /frf/0/csv#line 1: got no column "Coh", expected perhaps "coh"
stability: /frf/0/csv#line 1: got no column "arc", expected one)");
}

// A unit that is not known makes no other unit of it, in whatever brackets it stands.
TEST(ResponseTable, UnitsThatAreNotKnownAreRefused) {
  for (const char* f : {"Frequency (rad/min)", "Frequency (Bark)", "freq_rad_s",
                        "Frequency in parsec", "Frequency deg/s"})
    EXPECT_NE(refused({{"csv", {std::string(f) + ",Re [m/N],Im [m/N]", "1,2,3"}}})
                  .find("Hz, kHz, rad/s, rpm or cpm"),
              std::string::npos)
        << f;
  for (const char* real : {"Real (um/N rms)", "Real (V/V)", "Real mils/lbf"})
    EXPECT_NE(refused({{"unit", "mm/N"},
                       {"csv", {std::string("f,") + real + ",Imag", "1,2,3"}}})
                  .find("a unit of real: motion per force"),
              std::string::npos)
        << real;
  for (const char* phase : {"Phase (gon)", "Phase [turns]"})
    EXPECT_NE(refused({{"phase_unit", "deg"},
                       {"csv", {std::string("f,Mag [m/N],") + phase, "1,2,3"}}})
                  .find("a unit of phase: deg or rad"),
              std::string::npos)
        << phase;
  EXPECT_NE(refused({{"csv", {"f,Mag (dB re. 1 m/N),Phase (deg)", "1,2,3"}}})
                .find("a unit of magnitude"),
            std::string::npos);
}

TEST(ResponseTable, UnitsOfFrequencyInAnyCase) {
  for (const auto& [name, hertz] : {std::pair("Frequency (KHz)", 1e3),
                                    {"Freq HZ", 1.0},
                                    {"Frequency", 1.0},
                                    {"f (rad/sec)", 1 / (2 * M_PI)},
                                    {"Frequency [RPM]", 1.0 / 60}}) {
    const double unit = hertz;
    const auto lines = table(
        std::string(name) + ",Re(H1) [mm/N],Im(H1) [mm/N]", [&](double f, Complex y) {
          return text_of(f / unit) + "," + text_of(y.real()) + "," + text_of(y.imag());
        });
    SCOPED_TRACE(name);
    expect_modes(told({{"csv", lines}}), kTwo, 1e-6);
  }
}

TEST(ResponseTable, UnitsThatContradict) {
  EXPECT_EQ(refused({{"unit", "mm/N"}, {"csv", {"f,Re [m/N],Im [um/N]", "1,2,3"}}}),
            R"(stability: /frf/0/csv#line 1: got um/N, expected one unit, m/N
stability: /frf/0/unit: got "mm/N", expected none or "um/N", as in the header of the column)");
  EXPECT_EQ(
      refused({{"phase_unit", "rad"}, {"csv", {"f,amp [m/N],arg [deg]", "1,2,3"}}}),
      R"(stability: /frf/0/phase_unit: got "rad", expected none or that of the header)");
  EXPECT_EQ(
      refused({{"unit", "mm/N"}, {"csv", {"f,Re [N/mm],Im", "1,2,3"}}}),
      R"(stability: /frf/0/csv#line 1/Re [N~1mm]: got "N/mm", expected a unit of real: motion per force)");
  EXPECT_EQ(
      refused({{"unit", "mm/N"},
               {"phase_unit", "deg"},
               {"csv", {"f [1/min],amp [V/N],arg", "1,2,3"}}}),
      R"(stability: /frf/0/csv#line 1/amp [V~1N]: got "V/N", expected a unit of magnitude: motion per force, or dB
stability: /frf/0/csv#line 1/f [1~1min]: got "1/min", expected a unit of frequency_Hz: Hz, kHz, rad/s, rpm or cpm)");
}

}  // namespace
}  // namespace turnwright::document::response_table_test
