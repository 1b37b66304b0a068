#include "exchange/records/step_unit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "step_file.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::exchange {
namespace {

TEST(StepUnit, PrefixesOfTheSIAreTheirPowersOfTen) {
  const StepFile file(
      "#20=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.));"
      "#21=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.CENTI.,.METRE.));"
      "#22=SI_UNIT(*,.MICRO.,.METRE.);"
      "#23=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT(.MILLI.,.RADIAN.));"
      "#24=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());");
  EXPECT_DOUBLE_EQ(step_unit(file.exchange.at(20))->size, 1000);
  EXPECT_DOUBLE_EQ(step_unit(file.exchange.at(1))->size, 1);
  EXPECT_DOUBLE_EQ(step_unit(file.exchange.at(21))->size, 10);
  EXPECT_DOUBLE_EQ(step_unit(file.exchange.at(22))->size, 1e-3);
  EXPECT_DOUBLE_EQ(step_unit(file.exchange.at(23))->size, 1e-3);
  EXPECT_EQ(step_unit(file.exchange.at(23))->quantity, Quantity::angle);
  EXPECT_FALSE(step_unit(file.exchange.at(24)));
  EXPECT_FALSE(step_unit(file.exchange.at(9)));
}

TEST(StepUnit, ConversionsMultiply) {
  const StepFile file(
      "#20=(CONVERSION_BASED_UNIT('foot',#21)LENGTH_UNIT()NAMED_UNIT(*));"
      "#21=MEASURE_WITH_UNIT(LENGTH_MEASURE(12.),#2);");
  EXPECT_DOUBLE_EQ(step_unit(file.exchange.at(2))->size, 25.4);
  EXPECT_DOUBLE_EQ(step_unit(file.exchange.at(20))->size, 304.8);  // of the foot of 1959
  EXPECT_DOUBLE_EQ(step_unit(file.exchange.at(7))->size, std::numbers::pi / 180);
}

TEST(StepUnit, UnitThatIsDefinedByItselfIsRefused) {
  const StepFile file(
      "#20=(CONVERSION_BASED_UNIT('egg',#21)LENGTH_UNIT()NAMED_UNIT(*));"
      "#21=MEASURE_WITH_UNIT(LENGTH_MEASURE(2.),#22);"
      "#22=(CONVERSION_BASED_UNIT('hen',#23)LENGTH_UNIT()NAMED_UNIT(*));"
      "#23=MEASURE_WITH_UNIT(LENGTH_MEASURE(2.),#20);");
  EXPECT_THROW(step_unit(file.exchange.at(20)), InputError);
}

TEST(StepUnit, FactorsThatAreNoSizeAreRefused) {
  for (const auto factor : {"0.", "-25.4", "'inch'", "$"}) {
    const StepFile file(
        std::string("#20=(CONVERSION_BASED_UNIT('inch',#21)LENGTH_UNIT()NAMED_UNIT(*));"
                    "#21=MEASURE_WITH_UNIT(") +
        factor + ",#1);");
    EXPECT_THROW(step_unit(file.exchange.at(20)), InputError) << factor;
  }
  const StepFile file("#20=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MYRIA.,.METRE.));");
  EXPECT_THROW(step_unit(file.exchange.at(20)), InputError);
}

TEST(StepMeasure, IsReadInEveryForm) {
  const StepFile file(
      "#20=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(0.1),#2);"
      "#21=MEASURE_WITH_UNIT(POSITIVE_LENGTH_MEASURE(0.1),#2);"
      "#22=MEASURE_WITH_UNIT(0.1,#2);"
      "#23=MEASURE_REPRESENTATION_ITEM('nominal value',LENGTH_MEASURE(0.1),#2);"
      "#24=(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()"
      "MEASURE_WITH_UNIT(LENGTH_MEASURE(0.1),#2)REPRESENTATION_ITEM('nominal value'));");
  for (const Id id : {20, 21, 22, 23, 24}) {
    const auto measure = step_measure(file.exchange.at(id));
    ASSERT_TRUE(measure) << id;
    EXPECT_DOUBLE_EQ(measure->value, 2.54) << id;
    EXPECT_EQ(measure->quantity, Quantity::length) << id;
    EXPECT_EQ(measure_name(file.exchange.at(id)), id >= 23 ? "nominal value" : "") << id;
  }
}

TEST(StepMeasure, IsNothingWithoutAUnitOfLengthOrAngle) {
  const StepFile file(
      "#20=MEASURE_REPRESENTATION_ITEM('count',COUNT_MEASURE(3),$);"
      "#21=DESCRIPTIVE_REPRESENTATION_ITEM('dimensional note','theoretical');");
  EXPECT_FALSE(step_measure(file.exchange.at(20)));
  EXPECT_FALSE(step_measure(file.exchange.at(21)));
}

}  // namespace
}  // namespace turnwright::exchange
