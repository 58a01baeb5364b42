// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <ostream>

#include "CaseText.hpp"
#include "core/Case.hpp"
#include "core/Error.hpp"

namespace
{

using namespace gimdem;

/// One mistake in the good case, and what is said about it.
struct Mistake
{
    std::string name;
    std::string before;   ///< text of the good case ...
    std::string after;    ///< ... that is replaced by this
    std::string message;  ///< all of it
};

void PrintTo(Mistake const& mistake, std::ostream* out)
{
    *out << mistake.name;
}

// clang-format off
Mistake const mistakes[] = {
    // keys
    {"UnknownKey", "restitution", "resitution",
     "case.toml:28: unknown key \"resitution\" in [[contacts]] (no such setting); did you mean \"restitution\"?"},
    {"UnknownKeyLikeNoOther", "until", "wavelength",
     "case.toml:3: unknown key \"wavelength\" in [run] (no such setting); known are: until, client, grid, grids"},
    {"UnknownSection", "[walls]", "[wals]",
     "case.toml:34: unknown key \"wals\" (no such setting); did you mean \"walls\"?"},
    {"UnknownKeyOfInlineTable", "point = [0, 0, 0.045]", "piont = [0, 0, 0]",
     "case.toml:50: unknown key \"piont\" in [[output.planes]] (no such setting); did you mean \"point\"?"},
    {"MissingKey", "density = 7800\n", "",
     "case.toml:21: \"density\" is missing in [[materials]] (mass per volume of a particle [kg/m^3]); add e.g. density = 1150.0"},
    {"MissingKeyWithoutUnit", "name = \"steel\"\n", "",
     "case.toml:21: \"name\" is missing in [[materials]] (what contacts, walls and insertion call it); add e.g. name = \"bead\""},
    {"MissingSection", "[walls]\nmaterial = \"steel\"\n", "",
     "case.toml: [walls] is missing (what bounds the particles); add [walls] with material = \"bead\""},

    // types
    {"TextForNumber", "1150.0", "\"heavy\"",
     "case.toml:18: \"density\" in [[materials]] is a text (a number is needed); write e.g. density = 1150.0"},
    {"TruthForNumber", "7800", "true",
     "case.toml:23: \"density\" in [[materials]] is true or false (a number is needed); write e.g. density = 1150.0"},
    {"NumberForText", "\"serial\"", "1",
     "case.toml:7: \"schedule\" in [coupling] is a number (a text is needed); write e.g. schedule = \"serial\""},
    {"FractionForCount", "count = 100", "count = 100.5",
     "case.toml:39: \"count\" in [[insertion]] is a number (a whole number is needed); write e.g. count = 17563"},
    {"TwoNumbersForThree", "[0.0, 0.0, -9.81]", "[0.0, -9.81]",
     "case.toml:12: \"gravity\" in [dem] is an array (an array of three numbers is needed); write e.g. gravity = [0.0, 0.0, -9.81]"},
    {"DateForNumber", "30.0", "2001-01-01",
     "case.toml:9: \"timeout\" in [coupling] is a date or time (a number is needed); write e.g. timeout = 30.0"},
    {"OneSectionForList", "[[insertion]]", "[insertion]",
     "case.toml:36: \"insertion\" is a section (a list is needed: a section [[insertion]] for each)"},
    {"ListForOneSection", "[walls]", "[[walls]]",
     "case.toml:34: \"walls\" is an array (one section [walls] is needed)"},

    // ranges
    {"ZeroTime", "until = 1.0", "until = 0",
     "case.toml:3: \"until\" in [run] is 0 (must be > 0 s); write e.g. until = 1.0"},
    {"NegativeDiameter", "1.5e-3", "-1.5e-3",
     "case.toml:38: \"diameter\" in [[insertion]] is -0.0015 (must be > 0 m); write e.g. diameter = 1.545e-3"},
    {"NegativeDensity", "1150.0", "-3",
     "case.toml:18: \"density\" in [[materials]] is -3 (must be > 0 kg/m^3); write e.g. density = 1150.0"},
    {"ZeroYoungModulus", "1.2e5", "0.0",
     "case.toml:19: \"young_modulus\" in [[materials]] is 0 (must be > 0 Pa); write e.g. young_modulus = 1.2e5"},
    {"PoissonRatioAboveHalf", "0.33", "0.51",
     "case.toml:20: \"poisson_ratio\" in [[materials]] is 0.51 (must be in [0, 0.5]); write e.g. poisson_ratio = 0.33"},
    {"RestitutionTooSmall", "restitution = 0.9", "restitution = 0.04",
     "case.toml:28: \"restitution\" in [[contacts]] is 0.04 (must be in [0.05, 1]); write e.g. restitution = 0.9"},
    {"NegativeFriction", "friction = 0.3", "friction = -0.1",
     "case.toml:29: \"friction\" in [[contacts]] is -0.1 (must be >= 0); write e.g. friction = 0.3"},
    {"VoidFractionMinimumOne", "minimum = 0.1", "minimum = 1.0",
     "case.toml:47: \"void_fraction_minimum\" in [mapping] is 1 (must be in (0, 1)); write e.g. void_fraction_minimum = 0.1"},
    {"ZeroSkin", "skin = 0.2", "skin = 0.0",
     "case.toml:15: \"skin\" in [dem] is 0 (must be in (0, 1]); write e.g. skin = 0.3"},
    {"ZeroSampleInterval", "1e-3\nplanes", "0.0\nplanes",
     "case.toml:49: \"sample_interval\" in [output] is 0 (must be > 0 s); write e.g. sample_interval = 1e-3"},
    {"NegativeThreads", "threads = 2", "threads = -1",
     "case.toml:13: \"threads\" in [dem] is -1 (must be >= 0); write e.g. threads = 0"},
    {"TooManyThreads", "threads = 2", "threads = 3000000000",
     "case.toml:13: \"threads\" in [dem] is 3000000000 (must be at most 2147483647); write e.g. threads = 0"},
    {"NotANumber", "0.33", "nan",
     "case.toml:20: \"poisson_ratio\" in [[materials]] is nan (must be a finite number); write e.g. poisson_ratio = 0.33"},
    {"Infinite", "until = 1.0", "until = inf",
     "case.toml:3: \"until\" in [run] is inf (must be a finite number); write e.g. until = 1.0"},
    {"NotANumberInArray", "-9.81", "nan",
     "case.toml:12: \"gravity\" in [dem] is nan (must be a finite number); write e.g. gravity = [0.0, 0.0, -9.81]"},
    {"InfiniteCorner", "0.5]]", "inf]]",
     "case.toml:40: \"box\" in [[insertion]] is inf (must be a finite number); write e.g. box = [[0.0, 0.0, 0.0], [0.09, 0.008, 0.5]]"},

    // periodic domain
    {"PeriodicAxesMiscounted", "[walls]", "[domain]\nperiodic = [true]\n[walls]",
     "case.toml:35: \"periodic\" in [domain] is an array (an array of three, true or false is needed); "
     "write e.g. periodic = [true, true, false]"},
    {"PeriodicAxisAsNumber", "[walls]", "[domain]\nperiodic = [true, 1, false]\n[walls]",
     "case.toml:35: \"periodic\" in [domain] is an array (an array of three, true or false is needed); "
     "write e.g. periodic = [true, true, false]"},
    {"PeriodicWithoutBox", "[walls]", "[domain]\nperiodic = [false, true, false]\n[walls]",
     "case.toml:34: box in [domain] is empty along y (that axis is periodic, the box tells its period); "
     "write e.g. box = [[0.0, 0.0, 0.0], [0.05, 0.05, 0.05]]"},
    {"PeriodicBoxUpsideDown", "[walls]", "[domain]\nperiodic = [false, false, true]\nbox = [[0, 0, 1], [1, 1, 0]]\n[walls]",
     "case.toml:36: box in [domain] is empty along z (that axis is periodic, the box tells its period); "
     "write e.g. box = [[0.0, 0.0, 0.0], [0.05, 0.05, 0.05]]"},

    // words
    {"NegativeGraceTime", "schedule = \"serial\"", "grace_time = -1.0",
     "case.toml:7: \"grace_time\" in [coupling] is -1 (must be >= 0 s); write e.g. grace_time = 600.0"},
    {"UnknownEncoding", "schedule = \"serial\"", "encodings = [\"lz4\", \"sparce\"]",
     "case.toml:7: \"encodings\" in [coupling] is \"sparce\" (must be sparse | dense | float32 | lz4); did you mean \"sparse\"?"},
    {"EncodingThatIsNoList", "schedule = \"serial\"", "encodings = \"lz4\"",
     "case.toml:7: \"encodings\" in [coupling] is a text (an array of texts is needed); write e.g. encodings = [\"sparse\", \"lz4\"]"},
    {"EncodingsThatExclude", "schedule = \"serial\"", "encodings = [\"sparse\", \"dense\"]",
     "case.toml:7: \"encodings\" in [coupling] has sparse and dense (fields travel in one way or the other); remove one"},
    {"UnknownSchedule", "schedule = \"serial\"", "schedule = \"overlaped\"",
     "case.toml:7: \"schedule\" in [coupling] is \"overlaped\" (must be serial | overlapped | iterated); did you mean \"overlapped\"?"},
    {"UnknownBackend", "backend = \"serial\"", "backend = \"abacus\"",
     "case.toml:14: \"backend\" in [dem] is \"abacus\" (must be serial | openmp | cuda); write e.g. backend = \"openmp\""},
    {"UnknownMethod", "\"gim\"", "\"gmi\"",
     "case.toml:46: \"method\" in [mapping] is \"gmi\" (must be gim | gim-fixed | pcm | divided | fbsi | kernel | diffusion | exact | "
                              "power-diagram); did you mean \"gim\"?"},
    {"UnknownDrag", "[mapping]", "[fluid_forces]\ndrag = \"stokes\"\n[mapping]",
     "case.toml:46: \"drag\" in [fluid_forces] is \"stokes\" (must be none | beetstra); write e.g. drag = \"beetstra\""},
    {"EndpointWithoutPort", "\"ipc\"", "\"tcp://127.0.0.1\"",
     "case.toml:8: \"endpoint\" in [coupling] is \"tcp://127.0.0.1\" (must be ipc | ipc:///path | tcp://host:port); "
     "write e.g. endpoint = \"tcp://127.0.0.1:5570\""},
    {"EmptyName", "\"steel\"", "\"\"",
     "case.toml:22: \"name\" in [[materials]] is \"\" (must be not empty); write e.g. name = \"bead\""},

    // between settings
    {"UnknownContactLaw", "skin = 0.2\n", "contact_law = \"linaer\"\n",
     "case.toml:15: \"contact_law\" in [dem] is \"linaer\" (must be hertz-mindlin | linear); did you mean \"linear\"?"},
    {"StiffnessMissing", "skin = 0.2\n", "contact_law = \"linear\"\n",
     "case.toml:26: \"normal_stiffness\" is missing in [[contacts]] for [\"bead\", \"bead\"] (stiffness of the spring [N/m], "
     "needed for contact_law = \"linear\" in [dem]); add e.g. normal_stiffness = 1000.0"},
    {"RollingFrictionMissing", "skin = 0.2\n", "rolling_friction = \"cdt\"\n",
     "case.toml:26: \"rolling_friction\" is missing in [[contacts]] for [\"bead\", \"bead\"] (coefficient of rolling friction, "
     "needed for rolling_friction = \"cdt\" in [dem]); add e.g. rolling_friction = 0.05"},
    {"RollingFrictionWithoutALaw", "friction = 0.3\n", "friction = 0.3\nrolling_friction = 0.1\n",
     "case.toml:30: \"rolling_friction\" in [[contacts]] has no effect (rolling_friction = \"none\" in [dem]); remove it or "
     "choose rolling_friction = \"cdt\""},
    {"CohesionMissing", "skin = 0.2\n", "cohesion = \"sjkr\"\n",
     "case.toml:26: \"cohesion_energy_density\" is missing in [[contacts]] for [\"bead\", \"bead\"] (attraction per area of "
     "contact [J/m^3], needed for cohesion = \"sjkr\" in [dem]); add e.g. cohesion_energy_density = 5e4"},
    {"GridNotOnOffer", "grid = \"B\"", "grid = \"C\"",
     "case.toml:4: grid \"C\" in [run] is not on offer (it is not in grids); known are: A, B"},
    {"GridNotChosen", "grid = \"B\"\n", "",
     "case.toml:4: \"grid\" is missing in [run] (which of grids to use); add e.g. grid = \"A\""},
    {"MaterialTwice", "\"steel\"", "\"bead\"",
     "case.toml:22: material \"bead\" is defined twice (a name stands for one material); rename or remove one"},
    {"UnknownMaterialOfContact", "[\"bead\", \"bead\"]", "[\"bead\", \"beed\"]",
     "case.toml:27: material \"beed\" is not defined (no [[materials]] has this name); did you mean \"bead\"?"},
    {"UnknownMaterialOfWalls", "material = \"steel\"", "material = \"glass\"",
     "case.toml:35: material \"glass\" is not defined (no [[materials]] has this name); known are: bead, steel"},
    {"UnknownMaterialOfParticles", "material = \"bead\"", "material = \"baed\"",
     "case.toml:37: material \"baed\" is not defined (no [[materials]] has this name); did you mean \"bead\"?"},
    {"PairTwice", "[\"bead\", \"bead\"]", "[\"bead\", \"steel\"]",
     "case.toml:31: the pair [\"steel\", \"bead\"] is given twice (the order of the two does not matter); remove one"},
    {"PairMissing", "[\"steel\", \"bead\"]", "[\"steel\", \"steel\"]",
     "case.toml: no [[contacts]] for the materials \"bead\" and \"steel\" (particles of one can touch the other); "
     "add [[contacts]] with pair = [\"bead\", \"steel\"], restitution = 0.9, friction = 0.3"},
    {"MassAndCount", "count = 100", "count = 100\nmass = 0.1",
     "case.toml:39: both \"mass\" and \"count\" are given in [[insertion]] (one follows from the other); remove one"},
    {"NeitherMassNorCount", "count = 100\n", "",
     "case.toml:36: neither \"mass\" nor \"count\" is given in [[insertion]] (how many particles to insert); "
     "add e.g. mass = 0.039 or count = 17563"},
    {"BoxMissing", "box = [[0.0, 0.0, 0.0], [0.09, 0.008, 0.5]]\n", "",
     "case.toml:36: \"box\" is missing in [[insertion]] (where the lattice is [m]); "
     "add e.g. box = [[0.0, 0.0, 0.0], [0.09, 0.008, 0.5]]"},
    {"BoxUpsideDown", "0.008, 0.5]]", "-0.008, 0.5]]",
     "case.toml:40: box in [[insertion]] is empty along y (the first corner must be the lower one); "
     "write e.g. box = [[0.0, 0.0, 0.0], [0.09, 0.008, 0.5]]"},
    {"Overlap", "spacing = 1.65e-3", "spacing = 1.5e-3",
     "case.toml:41: particles of [[insertion]] can overlap at the start (spacing - 2 jitter = 0.00146 m is below the "
     "diameter 0.0015 m); raise spacing or lower jitter"},
    {"FileForLattice", "count = 100", "count = 100\nfile = \"a.csv\"",
     "case.toml:40: \"file\" in [[insertion]] has no effect (arrangement is \"lattice\"); remove it or change arrangement"},
    {"FileNotNamed", "count = 100", "arrangement = \"file\"",
     "case.toml:36: \"file\" is missing in [[insertion]] (CSV with the positions); add e.g. file = \"positions.csv\""},
    {"CountForFile", "count = 100", "count = 100\narrangement = \"file\"\nfile = \"a.csv\"",
     "case.toml:39: \"count\" in [[insertion]] has no effect (arrangement is \"file\"); remove it or change arrangement"},
    {"NormalZero", "normal = [0, 0, 1]", "normal = [0, 0, 0]",
     "case.toml:50: normal of plane \"low\" is zero (it has no direction); write e.g. normal = [0.0, 0.0, 1.0]"},
    {"InletWithoutOutlet", "outlet = \"outlet\"\n", "",
     "case.toml:51: only one of \"inlet\" and \"outlet\" is given in [output] (the pressure drop is taken from one to "
     "the other); add the other or remove this one"},
};
// clang-format on

std::string message_of(std::string const& text)
{
    try
    {
        parse_case(text, "case.toml");
    }
    catch (UserError const& error)
    {
        return error.what();
    }
    return "no error";
}

class BadCase : public testing::TestWithParam<Mistake>
{
};

TEST_P(BadCase, IsRefusedWithTheReason)
{
    Mistake const& mistake = GetParam();

    std::string const message = message_of(test::with(test::good_case, mistake.before, mistake.after));

    EXPECT_EQ(message, mistake.message);
}

INSTANTIATE_TEST_SUITE_P(Mistakes, BadCase, testing::ValuesIn(mistakes),
                         [](auto const& each) { return each.param.name; });

TEST(BadCaseFile, SyntaxErrorNamesLineAndColumn)
{
    std::string const message = message_of(test::with(test::good_case, "30.0", "30.0.1"));

    EXPECT_TRUE(message.starts_with("case.toml:9:15: not TOML (Error while parsing")) << message;
}

TEST(BadCaseFile, SectionGivenTwiceIsASyntaxError)
{
    std::string const message = message_of(test::good_case + "[run]\nuntil = 2.0\n");

    EXPECT_TRUE(message.starts_with("case.toml:53:")) << message;
}

TEST(BadCaseFile, PlaneNamedTwiceIsRefused)
{
    std::string const plane = "{ name = \"low\", point = [0, 0, 0.045], normal = [0, 0, 1] }";

    std::string const message = message_of(test::with(test::good_case, plane, plane + ", " + plane));

    EXPECT_EQ(message,
              "case.toml:50: plane \"low\" is defined twice (its columns would have the same name); rename one");
}

TEST(BadCaseFile, EmptyTextAsksForTheFirstSection)
{
    std::string const message = message_of("");

    EXPECT_EQ(message,
              "case.toml: [run] is missing (how long to simulate and on which mesh); add [run] with until = 1.0");
}

TEST(BadCaseFile, EmptyListIsRefused)
{
    std::string const message =
        message_of("materials = []\n[run]\nuntil = 1.0\n[dem]\ntime_step = 1e-5\ngravity = [0, 0, 0]\n");

    EXPECT_EQ(message,
              "case.toml:1: \"materials\" is an empty list (at least one is needed: what particles and walls are made "
              "of)");
}

}  // namespace
