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

/// Throw UserError where [insertion.sizes] or [inlets.sizes], at `path`, is no distribution, or where not just one of
/// it and `diameter` is given.
void check_sizes(std::optional<SizeSettings> const& sizes, double diameter, std::string const& path,
                 std::string const& list, Document const& document);

/// Throw UserError where [[inlets]] number `index` has no region, or more than one.
void check_inlet(InletSettings const& inlet, std::size_t index, Document const& document);

/// Throw UserError where [domain] is empty, contradicts itself, is absent in a run without a fluid or has no effect in
/// another, or where a run without a fluid has settings that it cannot have.
void check_domain(Case const& input, Document const& document);

/// Throw UserError where a [[contacts]] misses what the laws chosen in [dem] need, or has what they do not use.
void check_contact_laws(Case const& input, Document const& document);

/// Throw UserError where settings contradict each other or name what does not exist.
void check_case(Case const& input, Document const& document);

}  // namespace gimdem::case_file
