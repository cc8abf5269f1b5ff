// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/ini_file.h"

#include "message_of.h"
#include "temporary_folder.h"

namespace
{
using fild::testing::message_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

class IniFile : public ::testing::Test
{
 protected:
    mrpt::config::CConfigFileMemory load(const std::string& text) const
    {
        const auto path = folder_.path("test.ini");
        fild::testing::write_text(path, text);
        return fild::load_ini_file(path);
    }
    void write(const std::string& name, const std::string& text) const
    {
        fild::testing::write_text(folder_.path(name), text);
    }
    std::string error(const std::string& text) const
    {
        return message_of<std::runtime_error>([&] { load(text); });
    }

 private:
    fild::testing::TemporaryFolder folder_;
};

TEST_F(IniFile, ReadsKeysAndSkipsComments)
{
    const auto config =
        load("# head\n[a]\nx = 1 // one\n; note\n// note\ny= /p/q\tr ; end\r\n\n[b]\nz=\n");
    EXPECT_EQ(config.read_string("a", "x", ""), "1");
    EXPECT_EQ(config.read_string("a", "y", ""), "/p/q\tr");
    EXPECT_EQ(config.read_string("b", "z", "?"), "");
}

TEST(IniText, IsReadAsAFileOfItsName)
{
    const auto config = fild::load_ini_text("[a]\nx = 1\n", "default.ini");
    EXPECT_EQ(config.read_string("a", "x", ""), "1");
    EXPECT_THAT(
        message_of<std::runtime_error>([] { fild::load_ini_text("[a]\nx\n", "default.ini"); }),
        HasSubstr("default.ini:2: "));
}

TEST_F(IniFile, NamesPathAndLineOfWhatItRefuses)
{
    EXPECT_THAT(error("[a]\nx=1\nx=2\n"), HasSubstr("test.ini:3: key 'x' stands twice in [a]"));
    EXPECT_THAT(error("[a]\n[b]\n[a]\n"), HasSubstr("section [a] stands twice"));
    EXPECT_THAT(error("x=1\n"), HasSubstr("before the first [section]"));
    EXPECT_THAT(error("[a]\nx\n"), HasSubstr("neither '[section]' nor 'key = value'"));
    EXPECT_THAT(error("[a\n"), HasSubstr("closing bracket"));
    EXPECT_THAT(error("[a]\n=3\n"), HasSubstr("no key"));
    EXPECT_THAT(error("[a]\nx=1\nX=2\n"), HasSubstr("test.ini:3: 'X' has capital letters"));
    EXPECT_THAT(error("[A]\n"), HasSubstr("'A' has capital letters"));
}

TEST_F(IniFile, TakesOverItsBaseAndSaysWhatDiffers)
{
    write("base.ini", "[a]\nx=1\ny=2\n");
    const auto config = load("# head\nbase = base.ini // beside it\n[a]\ny=3\n[b]\nz=4\n");
    EXPECT_EQ(config.read_string("a", "x", ""), "1");
    EXPECT_EQ(config.read_string("a", "y", ""), "3");
    EXPECT_EQ(config.read_string("b", "z", ""), "4");
}

TEST_F(IniFile, RefusesABaseThatItCannotTakeOver)
{
    EXPECT_THAT(error("\nbase=none.ini\n"),
                AllOf(HasSubstr("test.ini:2: base: cannot read"), HasSubstr("none.ini;")));
    EXPECT_THAT(error("base=test.ini\n"), HasSubstr("the base has a base itself"));
    write("base.ini", "[a]\nx=1\nx=2\n");
    EXPECT_THAT(
        error("base=base.ini\n"),
        AllOf(HasSubstr("test.ini:1: base: "), HasSubstr("base.ini:3: key 'x' stands twice")));
    write("base.ini", "[a]\nx=1\n");
    EXPECT_THAT(error("base=base.ini\nbase=base.ini\n"), HasSubstr("'base' stands twice"));
    EXPECT_EQ(load("[a]\nbase=none.ini\n").read_string("a", "base", ""), "none.ini");
}

TEST_F(IniFile, PassesOverAByteOrderMark)
{
    EXPECT_EQ(load("\xEF\xBB\xBF[a]\nx=1\n").read_string("a", "x", ""), "1");
}

TEST_F(IniFile, RefusesCapitalLettersInOverrides)
{
    mrpt::config::CConfigFileMemory config;
    EXPECT_THAT(
        message_of<std::invalid_argument>([&] { fild::apply_overrides(config, {"A.x=1"}); }),
        HasSubstr("'A' has capital letters"));
}

TEST_F(IniFile, RefusesAFolder)
{
    EXPECT_THAT(message_of<std::runtime_error>([] { fild::load_ini_file("."); }),
                HasSubstr("cannot read the configuration file ."));
}

TEST_F(IniFile, RefusesAMissingFile)
{
    EXPECT_THAT(message_of<std::runtime_error>([] { fild::load_ini_file("no/such.ini"); }),
                AllOf(HasSubstr("no/such.ini"), HasSubstr("share/mrpt-fild/config-ini")));
}

TEST_F(IniFile, OverridesReplaceAndAddKeys)
{
    auto config = load("[a]\nx=1\n");
    fild::apply_overrides(config, {"a.x = 2", "b.path=/d.e/f=g"});
    EXPECT_EQ(config.read_string("a", "x", ""), "2");
    EXPECT_EQ(config.read_string("b", "path", ""), "/d.e/f=g");
}

TEST_F(IniFile, RefusesMalformedOverrides)
{
    mrpt::config::CConfigFileMemory config;
    for (const std::string text : {"x=1", "a.x", "a.=1", ".x=1", ""})
        EXPECT_THAT(
            message_of<std::invalid_argument>([&] { fild::apply_overrides(config, {text}); }),
            HasSubstr("'" + text + "'"));
}

struct TNumberOptions : fild::Options
{
    int x = 0;

 protected:
    void describe(fild::OptionVisitor& visitor) override { visitor.integer("x", x, 0, 10); }
};

TEST_F(IniFile, LoadsTheSectionsThatAreThere)
{
    TNumberOptions a;
    TNumberOptions b;
    fild::load_sections(load("[b]\nx=7\n"), {{"a", &a}, {"b", &b}});
    EXPECT_EQ(a.x, 0);
    EXPECT_EQ(b.x, 7);
}

TEST_F(IniFile, PassesOverTheSectionsOfOtherReaders)
{
    TNumberOptions a;
    fild::load_sections(load("[a]\nx=7\n[other]\ny=1\n"), {{"a", &a}}, {"other"});
    EXPECT_EQ(a.x, 7);
    const auto config = load("[othr]\ny=1\n");
    EXPECT_THAT(
        message_of<std::runtime_error>(
            [&] {
                fild::load_sections(config, {{"a", &a}}, {"other"});
            }),
        HasSubstr("unknown section [othr]; did you mean other? known sections: [a] [other]"));
}

TEST_F(IniFile, NamesUnknownSections)
{
    TNumberOptions a;
    TNumberOptions b;
    const auto config = load("[a]\nx=1\n[c]\nx=1\n");
    EXPECT_THAT(message_of<std::runtime_error>(
                    [&] {
                        fild::load_sections(config, {{"a", &a}, {"b", &b}});
                    }),
                HasSubstr("unknown section [c]; known sections: [a] [b]"));
}

}  // namespace
