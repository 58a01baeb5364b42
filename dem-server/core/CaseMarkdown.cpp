// SPDX-License-Identifier: BSD-3-Clause
#include "core/CaseSettings.hpp"

namespace gimdem
{

namespace
{

using case_file::Setting;

/// `a | b` inside a cell of a Markdown table.
std::string escaped(std::string text)
{
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
        text.insert(at, 1, '\\');
    return text;
}

std::string default_of(Setting const& setting)
{
    if (setting.required) return "required";
    // a default that a user could not write means: not given
    bool const is_none = setting.fallback.empty() || setting.fallback == "\"\"" || setting.fallback == "[]" ||
                         (setting.fallback == "0" && setting.rule.number_ok && !setting.rule.number_ok(0));
    return is_none ? "none" : '`' + setting.fallback + '`';
}

std::string row_of(Setting const& setting)
{
    std::string const range = setting.rule.text.empty() ? setting.type : setting.rule.text;
    return "| `" + setting.key + "` | " + setting.unit + " | " + escaped(range) + " | " + default_of(setting) + " | " +
           escaped(setting.purpose) + " |\n";
}

/// The leaves of a section as a table, then the sections in it.
std::string section_as_markdown(Setting const& section, std::string const& path)
{
    std::string text = "\n## `" + case_file::bracketed(path, section.is_list) + "`\n\n";
    text += section.purpose + (section.required ? "; required.\n" : ".\n");
    text += "\n| key | unit | range | default | what it is |\n|---|---|---|---|---|\n";
    for (auto const& setting : section.inner)
        if (setting.inner.empty()) text += row_of(setting);
    for (auto const& setting : section.inner)
        if (!setting.inner.empty()) text += section_as_markdown(setting, path + '.' + setting.key);
    return text;
}

}  // namespace

std::string settings_as_markdown()
{
    std::string text =
        "# Settings of a case file\n\nSI units. A `[section]` stands once, a `[[section]]` as often as needed.\n";
    for (auto const& field : settings_of(Case{}))
        if (field.setting.inner.empty())
            text += "\n`" + field.setting.key + "`: " + field.setting.purpose + ".\n";
        else
            text += section_as_markdown(field.setting, field.setting.key);
    return text;
}

}  // namespace gimdem
