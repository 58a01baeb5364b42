// SPDX-License-Identifier: BSD-3-Clause
/// What has to hold between settings of a case.
#pragma once

#include <cstddef>
#include <string>

#include <toml++/toml.h>

#include "core/Case.hpp"

namespace gimdem::case_file
{

/// The document that a case was read from, for the lines in messages.
struct Document
{
    std::string file;
    toml::table const& root;

    /// Whether the document has the setting, e.g. "insertion[0].mass".
    bool has(std::string const& path) const;

    /// `file:line` of the setting, or of the nearest section around it that the document has.
    std::string at(std::string path) const;
};

/// Path of a key of the entry `index` of a list of sections: "insertion[0].mass".
std::string entry(std::string const& list, std::size_t index, std::string const& key);

/// Throw UserError where [[insertion]] number `index` misses what its arrangement needs, has what would be without
/// effect, or would insert overlapping particles.
void check_insertion(InsertionSettings const& insertion, std::size_t index, Document const& document);

/// Throw UserError where [[wall]] misses what its shape needs, has what would be without effect, or has a direction of
/// no length.
void check_walls(Case const& input, Document const& document);

/// Throw UserError where a [[contacts]] misses what the laws chosen in [dem] need, or has what they do not use.
void check_contact_laws(Case const& input, Document const& document);

/// Throw UserError where settings contradict each other or name what does not exist.
void check_case(Case const& input, Document const& document);

}  // namespace gimdem::case_file
