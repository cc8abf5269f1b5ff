// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/options.h"

#include "message_of.h"

#include <mrpt/config/CConfigFileMemory.h>

#include <limits>

namespace
{
using fild::testing::message_of;
using mrpt::config::CConfigFileMemory;
using ::testing::HasSubstr;
using ::testing::Not;

enum class Colour
{
    red,
    green
};

struct TPaintOptions : fild::Options
{
    int coats = 2;
    double litres = 0.5;
    bool glossy = false;
    std::string name = "plain";
    Colour colour = Colour::red;

 protected:
    void describe(fild::OptionVisitor& visitor) override
    {
        visitor.integer("coats", coats, 1, 9);
        visitor.real("litres", litres, 0, 10);
        visitor.flag("glossy", glossy);
        visitor.text("name", name);
        visitor.choice<Colour>("colour", colour, {{"red", Colour::red}, {"green", Colour::green}});
    }
    void check_between_fields() const override
    {
        if (glossy && coats < 2) throw std::invalid_argument("glossy=true needs coats >= 2");
    }
};

TPaintOptions load(const std::string& body)
{
    TPaintOptions options;
    options.loadFromConfigFile(CConfigFileMemory("[paint]\n" + body), "paint");
    return options;
}

std::string load_error(const std::string& body)
{
    return message_of<std::runtime_error>([&] { load(body); });
}

TEST(Options, KeepsDefaultsOfAbsentKeys)
{
    const auto options = load("");
    EXPECT_EQ(options.coats, 2);
    EXPECT_EQ(options.name, "plain");
}

TEST(Options, ReadsEveryKindOfField)
{
    const auto options = load("coats=3\nlitres=1.25\nglossy=true\nname=a b\ncolour=green\n");
    EXPECT_EQ(options.coats, 3);
    EXPECT_DOUBLE_EQ(options.litres, 1.25);
    EXPECT_TRUE(options.glossy);
    EXPECT_EQ(options.name, "a b");
    EXPECT_EQ(options.colour, Colour::green);
}

TEST(Options, NamesTheKnownKeyThatIsLikeAnUnknownOne)
{
    for (const auto* typed : {"litre", "liters", "ltres", "itlres"})
        EXPECT_THAT(load_error(typed + std::string("=3\n")),
                    HasSubstr("'; did you mean litres? known keys: "))
            << typed;
    for (const auto* typed : {"x", "milk", "brush_size_in_metres"})
        EXPECT_THAT(load_error(typed + std::string("=3\n")),
                    HasSubstr(typed + std::string("'; known keys: ")));
    EXPECT_THAT(load_error(std::string(1000, 'l') + "=3\n"), Not(HasSubstr("did you mean")));
}

TEST(Options, NamesAnUnknownKeyAndTheKnownOnes)
{
    const auto message = load_error("coat=3\n");
    EXPECT_THAT(message, HasSubstr("[paint] unknown key 'coat'"));
    EXPECT_THAT(message, HasSubstr("coats"));
}

TEST(Options, RefusesHalfNumbers)
{
    EXPECT_THAT(load_error("coats=lots\n"), HasSubstr("coats='lots' is not a whole number"));
    EXPECT_THAT(load_error("coats=2.5\n"), HasSubstr("coats='2.5'"));
    EXPECT_THAT(load_error("coats=99999999999\n"), HasSubstr("coats='99999999999'"));
    EXPECT_THAT(load_error("litres=0.1abc\n"), HasSubstr("litres='0.1abc' is not a number"));
    EXPECT_THAT(load_error("litres=nan\n"), HasSubstr("litres='nan'"));
    EXPECT_THAT(load_error("litres=\n"), HasSubstr("litres=''"));
    EXPECT_THAT(load_error("glossy=yess\n"), HasSubstr("one of: true, false"));
    EXPECT_THAT(load_error("colour=blue\n"), HasSubstr("one of: red, green"));
}

TEST(Options, RefusesValuesOutsideTheRange)
{
    EXPECT_THAT(load_error("coats=0\n"), HasSubstr("[paint] coats=0 outside [1, 9]"));
    EXPECT_THAT(load_error("litres=-0.1\n"), HasSubstr("litres=-0.1 outside [0, 10]"));
    EXPECT_THAT(load_error("coats=1\nglossy=true\n"), HasSubstr("needs coats >= 2"));
}

TEST(Options, CheckCatchesWhatWasSetInCode)
{
    TPaintOptions options;
    options.litres = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(options.check(), std::invalid_argument);
}

TEST(Options, SurviveARoundTripThroughText)
{
    auto options = load("coats=7\nlitres=0.1\nglossy=true\ncolour=green\nname=x\n");
    CConfigFileMemory saved;
    options.saveToConfigFile(saved, "paint");
    TPaintOptions again;
    again.loadFromConfigFile(CConfigFileMemory(saved.getContent()), "paint");
    EXPECT_EQ(again.values(), options.values());
}

}  // namespace
