// SPDX-License-Identifier: BSD-3-Clause
#include "core/CaseChecks.hpp"
#include "core/CaseText.hpp"
#include "core/Error.hpp"

namespace gimdem::case_file
{

namespace
{

/// Settings of one [[insertion]], with the messages for those that are missing or have no effect.
class InsertionCheck
{
public:
    InsertionCheck(InsertionSettings const& insertion, std::size_t index, Document const& document)
        : insertion_(insertion), index_(index), document_(document)
    {
    }

    void check_lattice() const
    {
        require("diameter", "size of the particles [m]", "1.545e-3");
        require("box", "where the lattice is [m]", "[[0.0, 0.0, 0.0], [0.09, 0.008, 0.5]]");
        require("spacing", "distance of neighbours on the lattice [m]", "1.65e-3");
        refuse("file");
        refuse("sizes");
        check_amount();
        check_box();
        check_overlap();
    }

    void check_random() const
    {
        require("box", "where the particles are [m]", "[[0.0, 0.0, 0.0], [0.09, 0.008, 0.5]]");
        for (auto const* key : {"file", "spacing", "jitter"})
            refuse(key);
        check_sizes(insertion_.sizes, insertion_.diameter, path("sizes"), "insertion", document_);
        check_amount();
        check_box();
    }

    void check_file(std::filesystem::path const& file) const
    {
        require("file", "CSV with the positions", "\"positions.csv\"");
        for (auto const* key : {"mass", "count", "box", "spacing", "jitter", "sizes"})
            refuse(key);
        if (!std::filesystem::is_regular_file(file))
            throw UserError(at("file") + ": file " + file.string() +
                            " of [[insertion]] does not exist (the particles start where it says); give its path "
                            "relative to the case file");
    }

private:
    std::string path(std::string const& key) const { return entry("insertion", index_, key); }
    std::string at(std::string const& key) const { return document_.at(path(key)); }

    void require(std::string const& key, std::string const& purpose, std::string const& example) const
    {
        if (!document_.has(path(key)))
            throw UserError(at(key) + ": \"" + key + "\" is missing in [[insertion]] (" + purpose + "); add e.g. " +
                            key + " = " + example);
    }

    void refuse(std::string const& key) const
    {
        if (document_.has(path(key)))
            throw UserError(at(key) + ": \"" + key + "\" in [[insertion]] has no effect (arrangement is \"" +
                            insertion_.arrangement + "\"); remove it or change arrangement");
    }

    void check_amount() const
    {
        bool const mass = document_.has(path("mass"));
        bool const count = document_.has(path("count"));
        if (mass && count)
            throw UserError(at("count") +
                            ": both \"mass\" and \"count\" are given in [[insertion]] (one follows from "
                            "the other); remove one");
        if (!mass && !count)
            throw UserError(at("mass") +
                            ": neither \"mass\" nor \"count\" is given in [[insertion]] (how many particles "
                            "to insert); add e.g. mass = 0.039 or count = 17563");
    }

    void check_box() const
    {
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (!(insertion_.box[0][axis] < insertion_.box[1][axis]))
                throw UserError(at("box") + ": box in [[insertion]] is empty along " + "xyz"[axis] +
                                " (the first corner must be the lower one); write e.g. box = [[0.0, 0.0, 0.0], "
                                "[0.09, 0.008, 0.5]]");
    }

    void check_overlap() const
    {
        // two neighbours on the lattice, each displaced towards the other
        double const nearest = insertion_.spacing - 2 * insertion_.jitter;
        if (nearest < insertion_.diameter)
            throw UserError(
                at("spacing") +
                ": particles of [[insertion]] can overlap at the start (spacing - 2 jitter = " + to_text(nearest) +
                " m is below the diameter " + to_text(insertion_.diameter) + " m); raise spacing or lower jitter");
    }

    InsertionSettings const& insertion_;
    std::size_t index_;
    Document const& document_;
};

}  // namespace

void check_insertion(InsertionSettings const& insertion, std::size_t index, Document const& document)
{
    InsertionCheck const check(insertion, index, document);
    if (insertion.arrangement == "file")
        check.check_file(insertion.file);
    else if (insertion.arrangement == "random")
        check.check_random();
    else
        check.check_lattice();
}

}  // namespace gimdem::case_file
