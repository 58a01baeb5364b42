// SPDX-License-Identifier: BSD-3-Clause
/// Settings of insertion, inlets and domain: what is read, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "CaseText.hpp"
#include "core/Case.hpp"
#include "core/Error.hpp"

namespace
{

using namespace gimdem;
using testing::ElementsAre;
using testing::HasSubstr;

std::string const sizes = "[insertion.sizes]\ndistribution = \"uniform\"\nminimum = 1e-3\nmaximum = 2e-3\n";
std::string const lattice =
    "diameter = 1.5e-3\ncount = 100\nbox = [[0.0, 0.0, 0.0], [0.09, 0.008, 0.5]]\n"
    "spacing = 1.65e-3\njitter = 2e-5\n";
std::string const random_box = "arrangement = \"random\"\nmass = 0.01\nbox = [[0, 0, 0], [0.09, 0.008, 0.5]]\n";
std::string const inlet =
    "[[inlets]]\nmaterial = \"bead\"\ndiameter = 1e-3\nmass_rate = 0.1\n"
    "box = [[0, 0, 0.4], [0.09, 0.008, 0.41]]\n";

std::string random_case(std::string const& insertion)
{
    return test::with(test::good_case, lattice, insertion);
}

std::string with_inlet(std::string const& before = "", std::string const& after = "")
{
    return test::good_case + (before.empty() ? inlet : test::with(inlet, before, after));
}

/// The good case without a fluid.
std::string alone(std::string const& domain = "[domain]\nbox = [[0, 0, 0], [0.09, 0.008, 0.5]]\nopen = [\"zmax\"]\n")
{
    std::string text = test::with(test::good_case, "until = 1.0\n", "until = 1.0\nclient = \"none\"\n");
    auto const begin = text.find("[settle]"), end = text.find("[output]");
    text.erase(begin, end - begin);
    text.resize(text.find("planes = "));
    return text + domain;
}

std::string message_of(std::string const& text)
{
    try
    {
        parse_case(text, "case.toml");
        return "no error";
    }
    catch (UserError const& error)
    {
        return error.what();
    }
}

TEST(PopulationCase, RandomInsertionWithSizesIsRead)
{
    Case const input = parse_case(random_case(random_box + sizes), "case.toml");
    ASSERT_TRUE(input.insertion.at(0).sizes);
    EXPECT_EQ(input.insertion[0].sizes->distribution, "uniform");
    EXPECT_EQ(input.insertion[0].sizes->maximum, 2e-3);
    std::string const list =
        "[insertion.sizes]\ndistribution = \"discrete\"\ndiameters = [1e-3, 2e-3]\n"
        "mass_fractions = [0.4, 0.6]\n";
    EXPECT_THAT(parse_case(random_case(random_box + list), "case.toml").insertion[0].sizes->mass_fractions,
                ElementsAre(0.4, 0.6));
}

TEST(PopulationCase, BadSizesAreRefused)
{
    auto const message = [](std::string const& before, std::string const& after)
    { return message_of(random_case(random_box + test::with(sizes, before, after))); };
    EXPECT_THAT(message("maximum = 2e-3\n", ""), HasSubstr("\"maximum\" in [insertion.sizes] is missing"));
    EXPECT_THAT(message("maximum = 2e-3", "maximum = 1e-3"), HasSubstr("is not above minimum"));
    EXPECT_THAT(message("maximum", "mean = 1.0\nmaximum"), HasSubstr("\"mean\" in [insertion.sizes] has no effect"));
    EXPECT_THAT(message("minimum = 1e-3", "minimum = nan"), HasSubstr("must be a finite number"));
    EXPECT_THAT(message_of(random_case(random_box)), HasSubstr("neither \"diameter\" nor"))
        << message_of(random_case(random_box));
    EXPECT_THAT(message_of(random_case("diameter = 1e-3\n" + random_box + sizes)), HasSubstr("both \"diameter\""));
    std::string const list = "[insertion.sizes]\ndistribution = \"discrete\"\ndiameters = [1e-3, 2e-3]\n";
    EXPECT_THAT(message_of(random_case(random_box + list + "mass_fractions = [0.4, 0.5]\n")),
                HasSubstr("adds up to 0.9"));
    EXPECT_THAT(message_of(random_case(random_box + list + "mass_fractions = [1.0]\n")),
                HasSubstr("has 1 entries, diameters has 2"));
    EXPECT_THAT(message_of(random_case(random_box + list + "mass_fractions = [-0.4, 1.4]\n")),
                HasSubstr("must be > 0"));
}

TEST(PopulationCase, InletIsReadAndItsMistakesAreRefused)
{
    Case const input = parse_case(with_inlet(), "case.toml");
    ASSERT_EQ(input.inlets.size(), 1u);
    EXPECT_EQ(input.inlets[0].mass_rate, 0.1);
    EXPECT_THAT(message_of(with_inlet("\"bead\"", "\"sand\"")), HasSubstr("material \"sand\" is not defined"));
    EXPECT_THAT(message_of(with_inlet("box", "radius = 0.1\nbox")), HasSubstr("both a box and a disc"));
    EXPECT_THAT(message_of(with_inlet("box = [[0, 0, 0.4], [0.09, 0.008, 0.41]]", "")),
                HasSubstr("neither a box nor a disc"));
    EXPECT_THAT(message_of(with_inlet("box = [[0, 0, 0.4], [0.09, 0.008, 0.41]]", "radius = 0.1")),
                HasSubstr("has no normal"));
    EXPECT_THAT(message_of(with_inlet("0.41]]", "0.4]]")), HasSubstr("box in [[inlets]] is empty"));
    EXPECT_THAT(message_of(with_inlet("mass_rate = 0.1", "mass_rate = 0")), HasSubstr("must be > 0 kg/s"));
    EXPECT_THAT(message_of(with_inlet("box", "start = 2\nend = 1\nbox")), HasSubstr("is not after start"));
    // Steel of an inlet touches beads, walls and itself; the last pair is missing.
    EXPECT_THAT(message_of(with_inlet("\"bead\"", "\"steel\"")),
                HasSubstr("no [[contacts]] for the materials \"steel\" and \"steel\""));
}

TEST(PopulationCase, RunWithoutAFluidNeedsItsDomain)
{
    Case const input = parse_case(alone(), "case.toml");
    EXPECT_THAT(input.domain.open, ElementsAre("zmax"));
    EXPECT_EQ(input.domain.box[1][0], 0.09);
    EXPECT_THAT(message_of(alone("")), HasSubstr("[domain] is missing"));
    EXPECT_THAT(message_of(alone("[domain]\nbox = [[0, 0, 0], [0, 1, 1]]\n")), HasSubstr("box in [domain] is empty"));
    EXPECT_THAT(message_of(alone("[domain]\nbox = [[0, 0, 0], [1, 1, 1]]\nopen = [\"top\"]\n")),
                HasSubstr("\"top\" in open of [domain] is no side"));
    EXPECT_THAT(message_of(alone() + "[settle]\nduration = 1.0\n"), HasSubstr("settle has no effect"));
    EXPECT_THAT(message_of(test::good_case + "[domain]\nbox = [[0, 0, 0], [1, 1, 1]]\n"),
                HasSubstr("[domain] has no effect"));
}

TEST(PopulationCase, InletOutsideOfTheDomainIsRefused)
{
    EXPECT_EQ(message_of(alone() + inlet), "no error");
    EXPECT_THAT(message_of(alone() + test::with(inlet, "0.41]]", "0.51]]")),
                HasSubstr("goes from 0.4 to 0.51 m along z, beyond the box of [domain], 0 to 0.5 m"));
    std::string const disc = test::with(inlet, "box = [[0, 0, 0.4], [0.09, 0.008, 0.41]]",
                                        "centre = [0.045, 0.004, 0.5]\nnormal = [0, 0, 2]\nradius = 0.004");
    EXPECT_EQ(message_of(alone() + disc), "no error") << "it may touch the sides";
    EXPECT_THAT(message_of(alone() + test::with(disc, "[0, 0, 2]", "[0, 1, 1]")), HasSubstr("0.502828"));
    EXPECT_THAT(message_of(alone() + test::with(disc, "radius = 0.004", "radius = 0.005")),
                HasSubstr("goes from -0.001 to 0.009 m along y"));
}

TEST(PopulationCase, PeriodicAxisHasNoSides)
{
    auto const domain = [](std::string const& open)
    {
        return "[domain]\nbox = [[0, 0, 0], [0.09, 0.08, 0.5]]\nopen = [\"" + open +
               "\"]\nperiodic = [true, false, false]\n";
    };
    EXPECT_THAT(parse_case(alone(domain("zmax")), "case.toml").domain.periodic, ElementsAre(true, false, false));
    EXPECT_THAT(message_of(alone(domain("xmin"))),
                HasSubstr("\"xmin\" in open of [domain] has no effect (that axis is periodic)"));
    EXPECT_THAT(message_of(test::with(alone(domain("zmax")), "[walls]\n", "[walls]\nalso = [\"xmax\"]\n")),
                HasSubstr("\"xmax\" in also of [walls] has no effect (that axis is periodic)"));
    EXPECT_THAT(message_of(test::with(alone(domain("zmax")), "[walls]\n", "[walls]\nalso = [\"lid\"]\n")),
                HasSubstr("\"lid\" in also of [walls] is no side"));
}

TEST(PopulationCase, SomeParticlesMustCome)
{
    std::string text = test::good_case;
    auto const begin = text.find("[[insertion]]"), end = text.find("[settle]");
    text.erase(begin, end - begin);
    EXPECT_THAT(message_of(text), HasSubstr("[[insertion]] is missing"));
    EXPECT_EQ(message_of(text + inlet), "no error");
}

TEST(PopulationCase, IdentityIsOfWhatMovesTheParticles)
{
    auto const identity = [](std::string const& before, std::string const& after)
    { return parse_case(test::with(test::good_case, before, after), "case.toml").identity; };
    std::string const good = parse_case(test::good_case, "case.toml").identity;
    EXPECT_EQ(identity("until = 1.0", "until = 2.0"), good);
    EXPECT_EQ(identity("threads = 2", "threads = 1"), good);
    EXPECT_EQ(identity("sample_interval = 1e-3", "sample_interval = 2e-3"), good);
    EXPECT_EQ(identity("[dem]\n", "# a comment\n[dem]\n"), good);
    EXPECT_NE(identity("friction = 0.3", "friction = 0.31"), good);
    EXPECT_NE(identity("jitter = 2e-5", "jitter = 3e-5"), good);
}

}  // namespace
