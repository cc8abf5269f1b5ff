// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/config/CLoadableOptions.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace fild
{
/** Sees every field of an options struct once; what it does with it (load, save, check, list) is up
 *  to the visitor. This is how a field is written once and not four times. */
class OptionVisitor
{
 public:
    OptionVisitor() = default;
    OptionVisitor(const OptionVisitor&) = delete;
    OptionVisitor& operator=(const OptionVisitor&) = delete;
    virtual ~OptionVisitor() = default;

    /** A whole number in [min, max]. */
    virtual void integer(const std::string& key, int& value, int min, int max) = 0;
    /** A finite number in [min, max]. */
    virtual void real(const std::string& key, double& value, double min, double max) = 0;
    /** `true` or `false`. */
    virtual void flag(const std::string& key, bool& value) = 0;
    /** Any text, empty included. */
    virtual void text(const std::string& key, std::string& value) = 0;

    /** One of a few words, each standing for an enumerator. */
    template <class Enum>
    void choice(const std::string& key,
                Enum& value,
                const std::vector<std::pair<std::string, Enum>>& words)
    {
        std::vector<std::string> allowed;
        std::string word;
        for (const auto& [name, enumerator] : words)
        {
            allowed.push_back(name);
            if (enumerator == value) word = name;
        }
        one_of(key, word, allowed);
        for (const auto& [name, enumerator] : words)
            if (name == word) value = enumerator;
    }

 private:
    virtual void one_of(const std::string& key,
                        std::string& word,
                        const std::vector<std::string>& allowed) = 0;
};

/** Base of every options struct: one section of the .ini file.
 *
 *  A derived struct has public fields with in-class defaults and lists each in describe(), with its
 *  range. Loading is strict where MRPT's own readers are lenient: an unknown key, a half-number, a
 *  value outside its range or an unknown word is an error that names section, key, value and what
 * is allowed. Keys that are absent keep their value. Const members may run concurrently. */
class Options : public mrpt::config::CLoadableOptions
{
 public:
    /** \throw std::runtime_error as described above; the struct is then partly loaded. */
    void loadFromConfigFile(const mrpt::config::CConfigFileBase& source,
                            const std::string& section) final;
    void saveToConfigFile(mrpt::config::CConfigFileBase& target,
                          const std::string& section) const final;

    /** \throw std::invalid_argument naming the first field out of range, or fields that contradict
     *         each other. */
    void check() const;

    /** Keys and values as they would stand in an .ini file, in order of declaration. */
    std::vector<std::pair<std::string, std::string>> values() const;

 protected:
    /** Calls one member function of `visitor` for every field. */
    virtual void describe(OptionVisitor& visitor) = 0;

    /** Conditions between fields; \throw std::invalid_argument. */
    virtual void check_between_fields() const {}

 private:
    void describe_const(OptionVisitor& visitor) const;
};

}  // namespace fild
