// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/options.h"

#include "did_you_mean.h"
#include "fild/core/parse_number.h"
#include "fild/core/words.h"
#include "shortened.h"

#include <mrpt/config/CConfigFileBase.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>

namespace fild
{
namespace
{
/** The shortest text that reads back as the same number. */
std::string to_text(double value)
{
    std::array<char, 32> buffer{};
    const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return {buffer.data(), result.ptr};
}

/** Reads each field from a section, remembers which keys it knows. */
class Loader : public OptionVisitor
{
 public:
    Loader(const mrpt::config::CConfigFileBase& source, const std::string& section)
        : source_(source), section_(section)
    {
    }

    void integer(const std::string& key, int& value, int, int) override
    {
        number(key, value, "a whole number");
    }
    void real(const std::string& key, double& value, double, double) override
    {
        number(key, value, "a number");
    }
    void flag(const std::string& key, bool& value) override
    {
        std::string word = value ? "true" : "false";
        one_of(key, word, {"true", "false"});
        value = word == "true";
    }
    void text(const std::string& key, std::string& value) override
    {
        known_.insert(key);
        if (has(key)) value = source_.read_string(section_, key, "");
    }

    void reject_unknown() const
    {
        std::vector<std::string> keys;
        source_.getAllKeys(section_, keys);
        for (const auto& key : keys)
            if (known_.count(key) == 0)
            {
                const std::vector<std::string> known(known_.begin(), known_.end());
                throw std::runtime_error("[" + section_ + "] unknown key '" + shortened(key) +
                                         "'; " + did_you_mean(key, known) +
                                         "known keys: " + joined(known, ", "));
            }
    }

 private:
    void one_of(const std::string& key,
                std::string& word,
                const std::vector<std::string>& allowed) override
    {
        text(key, word);
        if (std::find(allowed.begin(), allowed.end(), word) == allowed.end())
            fail(key, word, "one of: " + joined(allowed, ", "));
    }

    template <class Number>
    void number(const std::string& key, Number& value, const std::string& kind)
    {
        std::string word;
        text(key, word);
        if (!has(key)) return;
        const auto parsed = parse_number<Number>(word);
        if (!parsed) fail(key, word, kind);
        value = *parsed;
    }

    bool has(const std::string& key) const
    {
        std::vector<std::string> keys;
        source_.getAllKeys(section_, keys);
        return std::find(keys.begin(), keys.end(), key) != keys.end();
    }

    [[noreturn]] void fail(const std::string& key,
                           const std::string& word,
                           const std::string& expected) const
    {
        throw std::runtime_error("[" + section_ + "] " + key + "='" + shortened(word) +
                                 "' is not " + expected);
    }

    const mrpt::config::CConfigFileBase& source_;
    std::string section_;
    std::set<std::string> known_;
};

/** Throws at the first number outside its range. */
class RangeChecker : public OptionVisitor
{
 public:
    void integer(const std::string& key, int& value, int min, int max) override
    {
        if (value < min || value > max)
            fail(key, std::to_string(value), std::to_string(min), std::to_string(max));
    }
    void real(const std::string& key, double& value, double min, double max) override
    {
        if (!(value >= min && value <= max)) fail(key, to_text(value), to_text(min), to_text(max));
    }
    void flag(const std::string&, bool&) override {}
    void text(const std::string&, std::string&) override {}

 private:
    void one_of(const std::string&, std::string&, const std::vector<std::string>&) override {}

    [[noreturn]] static void fail(const std::string& key,
                                  const std::string& value,
                                  const std::string& min,
                                  const std::string& max)
    {
        throw std::invalid_argument(key + "=" + value + " outside [" + min + ", " + max + "]");
    }
};

/** Collects keys and values as text. */
class Lister : public OptionVisitor
{
 public:
    void integer(const std::string& key, int& value, int, int) override
    {
        values.emplace_back(key, std::to_string(value));
    }
    void real(const std::string& key, double& value, double, double) override
    {
        values.emplace_back(key, to_text(value));
    }
    void flag(const std::string& key, bool& value) override
    {
        values.emplace_back(key, value ? "true" : "false");
    }
    void text(const std::string& key, std::string& value) override
    {
        values.emplace_back(key, value);
    }

    std::vector<std::pair<std::string, std::string>> values;

 private:
    void one_of(const std::string& key, std::string& word, const std::vector<std::string>&) override
    {
        values.emplace_back(key, word);
    }
};
}  // namespace

void Options::loadFromConfigFile(const mrpt::config::CConfigFileBase& source,
                                 const std::string& section)
{
    Loader loader(source, section);
    describe(loader);
    loader.reject_unknown();
    try
    {
        check();
    }
    catch (const std::invalid_argument& error)
    {
        throw std::runtime_error("[" + section + "] " + error.what());
    }
}

void Options::saveToConfigFile(mrpt::config::CConfigFileBase& target,
                               const std::string& section) const
{
    for (const auto& [key, value] : values()) target.write(section, key, value);
}

void Options::check() const
{
    RangeChecker checker;
    describe_const(checker);
    check_between_fields();
}

std::vector<std::pair<std::string, std::string>> Options::values() const
{
    Lister lister;
    describe_const(lister);
    return lister.values;
}

// RangeChecker and Lister change no field, so that one describe() can serve loading and reading.
void Options::describe_const(OptionVisitor& visitor) const
{
    const_cast<Options*>(this)->describe(visitor);
}

}  // namespace fild
