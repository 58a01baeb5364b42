// SPDX-License-Identifier: BSD-3-Clause
#include "core/CaseReader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "core/CaseText.hpp"
#include "core/Error.hpp"
#include "core/NearestKey.hpp"

namespace gimdem::case_file
{

std::string to_text(double value)
{
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string locate(std::string const& file, toml::node const* node)
{
    if (!node || !node->source().begin) return file;
    return file + ':' + std::to_string(node->source().begin.line);
}

std::string bracketed(std::string const& section, bool is_list)
{
    return is_list ? "[[" + section + "]]" : '[' + section + ']';
}

namespace
{

/// ` in [run]`, or nothing at the top of the document.
std::string in_section(std::string const& section, bool is_list)
{
    return section.empty() ? "" : " in " + bracketed(section, is_list);
}

/// "a text", "an array": what the user wrote instead.
std::string kind_of(toml::node const& node)
{
    switch (node.type())
    {
        case toml::node_type::table:
            return "a section";
        case toml::node_type::array:
            return "an array";
        case toml::node_type::string:
            return "a text";
        case toml::node_type::integer:
        case toml::node_type::floating_point:
            return "a number";
        case toml::node_type::boolean:
            return "true or false";
        default:
            return "a date or time";
    }
}

[[noreturn]] void fail_type(Node const& node)
{
    node.fail("is " + kind_of(node.value), node.setting.type + " is needed");
}

[[noreturn]] void fail_rule(Node const& node, std::string const& value)
{
    std::string const unit = node.setting.unit.empty() ? "" : ' ' + node.setting.unit;
    node.fail("is " + value, "must be " + node.setting.rule.text + unit);
}

void check_rule(Node const& node, double value)
{
    if (node.setting.rule.number_ok && !node.setting.rule.number_ok(value)) fail_rule(node, to_text(value));
}

/// A finite number, whole or not.
double to_number(Node const& node, toml::node const& value)
{
    auto const number = value.value<double>();
    if (!number || !value.is_number()) fail_type(node);
    if (!std::isfinite(*number)) node.fail("is " + to_text(*number), "must be a finite number");
    return *number;
}

std::string to_string(Node const& node, toml::node const& value)
{
    auto const text = value.value_exact<std::string>();
    if (!text) fail_type(node);
    return *text;
}

toml::array const& to_array(Node const& node, toml::node const& value, std::size_t size)
{
    auto const* array = value.as_array();
    if (!array || array->size() != size) fail_type(node);
    return *array;
}

std::array<double, 3> to_triple(Node const& node, toml::node const& value)
{
    auto const& array = to_array(node, value, 3);
    return {to_number(node, array[0]), to_number(node, array[1]), to_number(node, array[2])};
}

template <class Integer>
void read_integer(Node const& node, Integer& target)
{
    auto const number = node.value.value_exact<std::int64_t>();
    if (!number) fail_type(node);
    check_rule(node, static_cast<double>(*number));
    if (!std::in_range<Integer>(*number))
        node.fail("is " + to_text(*number), "must be at most " + to_text(std::numeric_limits<Integer>::max()));
    target = static_cast<Integer>(*number);
}

void check_word(Node const& node, std::string const& word)
{
    auto const& rule = node.setting.rule;
    if (!rule.string_ok || rule.string_ok(word)) return;
    std::string const nearest = nearest_key(word, rule.words);
    if (!nearest.empty())
        throw UserError(locate(node.file, &node.value) + ": \"" + node.setting.key + '"' +
                        in_section(node.section, node.section_is_list) + " is \"" + word + "\" (must be " + rule.text +
                        "); did you mean \"" + nearest + "\"?");
    fail_rule(node, to_text(word));
}

}  // namespace

void Node::fail(std::string const& problem, std::string const& reason) const
{
    std::string text = locate(file, &value) + ": \"" + setting.key + '"' + in_section(section, section_is_list);
    text += ' ' + problem + " (" + reason + ')';
    if (!setting.example.empty()) text += "; write e.g. " + setting.key + " = " + setting.example;
    throw UserError(text);
}

void read(Node const& node, double& target)
{
    target = to_number(node, node.value);
    check_rule(node, target);
}

void read(Node const& node, int& target)
{
    read_integer(node, target);
}
void read(Node const& node, std::int64_t& target)
{
    read_integer(node, target);
}
void read(Node const& node, std::uint64_t& target)
{
    read_integer(node, target);
}

void read(Node const& node, bool& target)
{
    auto const flag = node.value.value_exact<bool>();
    if (!flag) fail_type(node);
    target = *flag;
}

void read(Node const& node, std::string& target)
{
    target = to_string(node, node.value);
    check_word(node, target);
}

void read(Node const& node, std::filesystem::path& target)
{
    target = to_string(node, node.value);
}
void read(Node const& node, std::array<double, 3>& target)
{
    target = to_triple(node, node.value);
}

void read(Node const& node, std::array<std::array<double, 3>, 2>& target)
{
    auto const& corners = to_array(node, node.value, 2);
    target = {to_triple(node, corners[0]), to_triple(node, corners[1])};
}

void read(Node const& node, std::array<std::string, 2>& target)
{
    auto const& pair = to_array(node, node.value, 2);
    target = {to_string(node, pair[0]), to_string(node, pair[1])};
}

void read(Node const& node, std::array<bool, 3>& target)
{
    auto const& flags = to_array(node, node.value, 3);
    for (std::size_t i = 0; i < 3; ++i)
    {
        auto const flag = flags[i].value_exact<bool>();
        if (!flag) fail_type(node);
        target[i] = *flag;
    }
}

void read(Node const& node, std::vector<std::string>& target)
{
    if (!node.value.is_array()) fail_type(node);
    target.clear();
    for (auto const& element : *node.value.as_array())
    {
        target.push_back(to_string(node, element));
        check_word(node, target.back());
    }
}

void read(Node const& node, std::vector<double>& target)
{
    if (!node.value.is_array()) fail_type(node);
    target.clear();
    for (auto const& element : *node.value.as_array())
    {
        target.push_back(to_number(node, element));
        check_rule(node, target.back());
    }
}

void refuse_unknown_keys(Node const& section, toml::table const& table, std::vector<std::string> const& known)
{
    for (auto const& [key, value] : table)
    {
        if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
        throw UserError(section.file + ':' + std::to_string(key.source().begin.line) + ": unknown key \"" +
                        std::string(key.str()) + '"' + in_section(path_of(section), section.setting.is_list) +
                        " (no such setting); " + suggest_key(key.str(), known));
    }
}

void fail_missing(Node const& section, Setting const& missing)
{
    std::string const in = in_section(path_of(section), section.setting.is_list);
    std::string const unit = missing.unit.empty() ? "" : " [" + missing.unit + ']';
    if (missing.inner.empty())
        throw UserError(locate(section.file, in.empty() ? nullptr : &section.value) + ": \"" + missing.key +
                        "\" is missing" + in + " (" + missing.purpose + unit + "); add e.g. " + missing.key + " = " +
                        missing.example);
    std::string with;
    for (auto const& setting : missing.inner)
        if (setting.required) with += (with.empty() ? " with " : ", ") + setting.key + " = " + setting.example;
    throw UserError(section.file + ": " + bracketed(missing.key, missing.is_list) + " is missing (" + missing.purpose +
                    "); add " + bracketed(missing.key, missing.is_list) + with);
}

toml::table const& table_of(Node const& node)
{
    if (!node.value.is_table())
        node.fail("is " + kind_of(node.value), "one section " + bracketed(path_of(node), false) + " is needed");
    return *node.value.as_table();
}

std::vector<toml::table const*> tables_of(Node const& node)
{
    std::string const reason = "a list is needed: a section " + bracketed(path_of(node), true) + " for each";
    if (!node.value.is_array()) node.fail("is " + kind_of(node.value), reason);
    std::vector<toml::table const*> tables;
    for (auto const& element : *node.value.as_array())
        if (element.is_table())
            tables.push_back(element.as_table());
        else
            node.fail("holds " + kind_of(element), reason);
    if (tables.empty() && node.setting.required)
        node.fail("is an empty list", "at least one is needed: " + node.setting.purpose);
    return tables;
}

std::string path_of(Node const& node)
{
    return node.section.empty() ? node.setting.key : node.section + '.' + node.setting.key;
}

}  // namespace gimdem::case_file
