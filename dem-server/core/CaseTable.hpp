// SPDX-License-Identifier: BSD-3-Clause
/// How the tables of settings are written: one line each, required(...) or optional(...).
#pragma once

#include "core/CaseReader.hpp"
#include "core/CaseText.hpp"

namespace gimdem::case_file
{

// clang-format off
inline std::string type_of(double)                                          { return "a number"; }
inline std::string type_of(bool)                                            { return "true or false"; }
template <std::integral Integer> std::string type_of(Integer)               { return "a whole number"; }
inline std::string type_of(std::string const&)                              { return "a text"; }
inline std::string type_of(std::filesystem::path const&)                    { return "a text"; }
inline std::string type_of(std::array<double, 3> const&)                    { return "an array of three numbers"; }
inline std::string type_of(std::array<std::array<double, 3>, 2> const&)     { return "an array of two corners"; }
inline std::string type_of(std::array<std::string, 2> const&)               { return "an array of two texts"; }
inline std::string type_of(std::array<bool, 3> const&)                      { return "an array of three, true or false"; }
inline std::string type_of(std::vector<std::string> const&)                 { return "an array of texts"; }
inline std::string type_of(std::vector<double> const&)                      { return "an array of numbers"; }
// clang-format on

/// The settings of a section without what reads them.
template <HasSettings Section>
std::vector<Setting> describe(Section const& section)
{
    std::vector<Setting> settings;
    for (auto const& field : settings_of(section))
        settings.push_back(field.setting);
    return settings;
}

// what only the type of a member tells
template <class T>
void complete(Setting& setting, T const& value)
{
    setting.type = type_of(value);
    setting.fallback = to_text(value);
}

template <HasSettings Section>
void complete(Setting& setting, Section const& section)
{
    setting.inner = describe(section);
}

template <HasSettings Section>
void complete(Setting& setting, std::optional<Section> const&)
{
    setting.inner = describe(Section{});
}

template <HasSettings Section>
void complete(Setting& setting, std::vector<Section> const&)
{
    setting.inner = describe(Section{});
    setting.is_list = true;
}

/// A setting that fills `member` of Section and keeps the member's own default where it is not given.
template <class Section, class T>
Field<Section> optional(std::string key, T Section::*member, std::string unit, Rule rule, std::string example,
                        std::string purpose)
{
    Setting setting{std::move(key), std::move(unit), std::move(rule), std::move(example), std::move(purpose)};
    complete(setting, Section{}.*member);
    return {std::move(setting), [member](Node const& node, Section& section) { read(node, section.*member); }};
}

/// The same for a setting without which there is no case.
template <class Section, class T>
Field<Section> required(std::string key, T Section::*member, std::string unit, Rule rule, std::string example,
                        std::string purpose)
{
    auto field =
        optional(std::move(key), member, std::move(unit), std::move(rule), std::move(example), std::move(purpose));
    field.setting.required = true;
    field.setting.fallback.clear();
    return field;
}

/// Sections have no unit, range or example of their own.
template <class Section, class T>
Field<Section> optional(std::string key, T Section::*member, std::string purpose)
{
    return optional(std::move(key), member, "", anything(), "", std::move(purpose));
}

template <class Section, class T>
Field<Section> required(std::string key, T Section::*member, std::string purpose)
{
    return required(std::move(key), member, "", anything(), "", std::move(purpose));
}

}  // namespace gimdem::case_file
