// SPDX-License-Identifier: BSD-3-Clause
/// How a described setting is read from TOML: type, range, presence, and the message where one of them is wrong.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <toml++/toml.h>

namespace gimdem::case_file
{

/// Which values a setting may have.
struct Rule
{
    std::string text;                                   ///< as messages put it: "> 0", "in [0, 1]", "a | b"
    std::function<bool(double)> number_ok;              ///< empty: any finite number
    std::function<bool(std::string const&)> string_ok;  ///< empty: any text
    std::vector<std::string> words;                     ///< the only texts allowed, if not empty
};

Rule anything();
Rule above(double low);                  ///< > low
Rule at_least(double low);               ///< >= low
Rule within(double low, double high);    ///< in [low, high]
Rule between(double low, double high);   ///< in (low, high)
Rule fraction(double low, double high);  ///< in (low, high]
Rule one_of(std::vector<std::string> const& words);
Rule not_empty();
Rule endpoint();  ///< ipc | ipc:///path | tcp://host:port

/// What a setting is: for reading, for messages and for the documentation.
struct Setting
{
    std::string key;
    std::string unit;     ///< SI, empty where it has none
    Rule rule;            ///< allowed values
    std::string example;  ///< a value in TOML
    std::string purpose;  ///< what it is for
    bool required = false;
    std::string type{};            ///< "number", "text", ...; empty for a section
    std::string fallback{};        ///< value where it is not given
    bool is_list = false;          ///< a section that may be repeated, [[key]]
    std::vector<Setting> inner{};  ///< the settings of a section
};

/// A node of the document with what is known about it.
struct Node
{
    toml::node const& value;
    Setting const& setting;
    std::string section;  ///< where it stands: "" at the top, "run", "output.planes"
    bool section_is_list;
    std::string const& file;

    /// Throw UserError `file:line: "key" in [section] problem (reason); write e.g. key = example`.
    [[noreturn]] void fail(std::string const& problem, std::string const& reason) const;
};

/// `file:line`, or `file` for a node that is not in the document.
std::string locate(std::string const& file, toml::node const* node);

/// `[run]`, `[[materials]]`.
std::string bracketed(std::string const& section, bool is_list);

// leaves: each checks type, finiteness and rule
void read(Node const& node, double& target);
void read(Node const& node, int& target);
void read(Node const& node, std::int64_t& target);
void read(Node const& node, std::uint64_t& target);
void read(Node const& node, bool& target);
void read(Node const& node, std::string& target);
void read(Node const& node, std::filesystem::path& target);
void read(Node const& node, std::array<double, 3>& target);
void read(Node const& node, std::array<std::array<double, 3>, 2>& target);
void read(Node const& node, std::array<std::string, 2>& target);
void read(Node const& node, std::array<bool, 3>& target);
void read(Node const& node, std::vector<std::string>& target);
void read(Node const& node, std::vector<double>& target);

/// A setting together with the member of Section that it fills.
template <class Section>
struct Field
{
    Setting setting;
    std::function<void(Node const&, Section&)> read;
};

template <class Section>
using Fields = std::vector<Field<Section>>;

/// A struct that has a table of settings, found as settings_of(section).
template <class T>
concept HasSettings = requires(T const& section)
{
    settings_of(section);
};

/// Throw UserError for a key of `table` that is none of `known`.
void refuse_unknown_keys(Node const& section, toml::table const& table, std::vector<std::string> const& known);

/// Throw UserError because `missing` is not in the section.
[[noreturn]] void fail_missing(Node const& section, Setting const& missing);

/// The table of a section node, the tables of a list of sections. Throw UserError where it is something else.
toml::table const& table_of(Node const& node);
std::vector<toml::table const*> tables_of(Node const& node);

/// Path of the section that `node` is: "output" + "planes" -> "output.planes".
std::string path_of(Node const& node);

template <HasSettings Section>
void read_section(Node const& node, toml::table const& table, Section& target)
{
    auto const& fields = settings_of(target);
    std::vector<std::string> known;
    for (auto const& field : fields)
        known.push_back(field.setting.key);
    refuse_unknown_keys(node, table, known);

    for (auto const& field : fields)
        if (auto const* value = table.get(field.setting.key))
            field.read({*value, field.setting, path_of(node), node.setting.is_list, node.file}, target);
        else if (field.setting.required)
            fail_missing({table, node.setting, node.section, node.section_is_list, node.file}, field.setting);
}

template <HasSettings Section>
void read(Node const& node, Section& target)
{
    read_section(node, table_of(node), target);
}

template <HasSettings Section>
void read(Node const& node, std::optional<Section>& target)
{
    read_section(node, table_of(node), target.emplace());
}

template <HasSettings Section>
void read(Node const& node, std::vector<Section>& target)
{
    for (auto const* table : tables_of(node))
        read_section({*table, node.setting, node.section, node.section_is_list, node.file}, *table,
                     target.emplace_back());
}

}  // namespace gimdem::case_file
