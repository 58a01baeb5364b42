// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "CaseText.hpp"
#include "core/Case.hpp"
#include "core/Error.hpp"

namespace
{

using namespace gimdem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

/// A folder that is gone at the end.
struct Folder
{
    Folder() : path(testing::TempDir() + "gimdem_case_" + std::to_string(::getpid()))
    {
        std::filesystem::create_directories(path);
    }
    ~Folder() { std::filesystem::remove_all(path); }

    std::filesystem::path path;
};

std::filesystem::path const wachem_bed = std::filesystem::path(GIMDEM_CASES) / "wachem-bed/case.toml";

/// The number behind `key =` in a text where the key stands once.
double number_in(std::string const& text, std::string const& key)
{
    std::string const start = "\n" + key + " = ";
    auto const at = text.find(start);
    return at == std::string::npos ? NAN : std::stod(text.substr(at + start.size()));
}

TEST(CaseFile, ShippedCaseHasTheNumbersOfThePaper)
{
    Case const input = read_case(wachem_bed);

    ASSERT_EQ(input.materials.size(), 1u);
    EXPECT_EQ(input.materials[0].density, 1150.0);
    EXPECT_EQ(input.materials[0].young_modulus, 1.2e5);
    EXPECT_EQ(input.materials[0].poisson_ratio, 0.33);
    ASSERT_EQ(input.contacts.size(), 1u);
    EXPECT_EQ(input.contacts[0].restitution, 0.9);
    EXPECT_EQ(input.contacts[0].friction, 0.3);
    EXPECT_THAT(input.dem.gravity, ElementsAre(0, 0, -9.81));
    ASSERT_EQ(input.insertion.size(), 1u);
    EXPECT_EQ(input.insertion[0].diameter, 1.545e-3);
    EXPECT_THAT(input.insertion[0].box[1], ElementsAre(0.09, 0.008, 0.5));
    ASSERT_EQ(input.output.planes.size(), 1u);
    EXPECT_THAT(input.output.planes[0].point, ElementsAre(0, 0, 0.045));
}

TEST(CaseFile, ShippedCaseGivesTheNumbersItStates)
{
    std::ifstream in(wachem_bed);
    std::string const text(std::istreambuf_iterator<char>(in), {});

    Case const input = read_case(wachem_bed);

    EXPECT_EQ(input.run.until, number_in(text, "until"));
    EXPECT_EQ(input.coupling.timeout, number_in(text, "timeout"));
    EXPECT_EQ(input.dem.time_step, number_in(text, "time_step"));
    EXPECT_EQ(input.insertion.at(0).spacing, number_in(text, "spacing"));
    EXPECT_EQ(input.insertion.at(0).jitter, number_in(text, "jitter"));
    EXPECT_EQ(input.settle.value().duration, number_in(text, "duration"));
    EXPECT_EQ(input.settle.value().kinetic_energy, number_in(text, "kinetic_energy"));
    EXPECT_EQ(input.mapping.void_fraction_minimum, number_in(text, "void_fraction_minimum"));
    EXPECT_EQ(input.output.sample_interval, number_in(text, "sample_interval"));
    EXPECT_EQ(input.output.particle_interval, number_in(text, "particle_interval"));
    EXPECT_THAT(input.run.grids, Contains(input.run.grid));
}

TEST(CaseFile, SettingNotGivenKeepsItsDefault)
{
    Case const input = parse_case(test::with(test::good_case, "skin = 0.2\n", ""), "case.toml");

    EXPECT_EQ(input.dem.skin, DemSettings{}.skin);
    EXPECT_EQ(input.coupling.connect_time, CouplingSettings{}.connect_time);
    EXPECT_EQ(input.fluid_forces.drag, "beetstra");
    EXPECT_TRUE(input.fluid_forces.pressure_gradient);
}

TEST(CaseFile, SectionNotGivenIsAbsent)
{
    Case const input = parse_case(test::with(test::good_case, "[settle]\nduration = 0.5\n", ""), "case.toml");

    EXPECT_FALSE(input.settle.has_value());
}

TEST(CaseFile, EveryGivenSettingArrives)
{
    Case const input = parse_case(test::good_case, "case.toml");

    EXPECT_EQ(input.title, "small");
    EXPECT_EQ(input.coupling.timeout, 30.0);
    EXPECT_EQ(input.dem.threads, 2);
    EXPECT_EQ(input.dem.backend, "serial");
    EXPECT_EQ(input.dem.skin, 0.2);
    EXPECT_EQ(input.materials[1].density, 7800.0);
    EXPECT_THAT(input.contacts[1].pair, ElementsAre("steel", "bead"));
    EXPECT_EQ(input.walls.material, "steel");
    EXPECT_EQ(input.insertion[0].count, 100);
    EXPECT_EQ(input.insertion[0].spacing, 1.65e-3);
    EXPECT_EQ(input.insertion[0].jitter, 2e-5);
    EXPECT_EQ(input.settle->duration, 0.5);
    EXPECT_EQ(input.output.sample_interval, 1e-3);
    EXPECT_EQ(input.output.outlet, "outlet");
}

TEST(CaseFile, PeriodicDomainArrives)
{
    std::string const domain = "[domain]\nperiodic = [true, false, true]\nbox = [[0, 0, -1], [0.5, 0, 2]]\n";
    Case const input = parse_case(test::with(test::good_case, "[walls]", domain + "[walls]"), "case.toml");

    EXPECT_THAT(input.domain.periodic, ElementsAre(true, false, true));
    EXPECT_THAT(input.domain.box[0], ElementsAre(0, 0, -1));
    EXPECT_THAT(input.domain.box[1], ElementsAre(0.5, 0, 2));
    EXPECT_THAT(parse_case(test::good_case, "case.toml").domain.periodic, ElementsAre(false, false, false));
}

TEST(CaseFile, EndpointsOfAllKindsAreTaken)
{
    for (std::string const endpoint : {"ipc", "ipc:///tmp/bed", "tcp://127.0.0.1:5570", "tcp://[::1]:1"})
    {
        Case const input = parse_case(test::with(test::good_case, "\"ipc\"", '"' + endpoint + '"'), "case.toml");

        EXPECT_EQ(input.coupling.endpoint, endpoint);
    }
}

TEST(CaseFile, PositionsAreFoundBesideTheCase)
{
    Folder const folder;
    std::ofstream(folder.path / "start.csv") << "x,y,z\n";
    auto const lattice = test::good_case.substr(test::good_case.find("count = 100"));
    auto const lattice_size = lattice.find("[settle]");
    std::string text =
        test::with(test::good_case, lattice.substr(0, lattice_size), "arrangement = \"file\"\nfile = \"start.csv\"\n");

    Case const input = parse_case(text, folder.path / "case.toml");

    EXPECT_EQ(input.insertion[0].file, folder.path / "start.csv");
    auto const relative = std::filesystem::relative(folder.path / "case.toml");
    EXPECT_TRUE(parse_case(text, relative).insertion[0].file.is_absolute());
    std::filesystem::remove(folder.path / "start.csv");
    EXPECT_THROW(parse_case(text, folder.path / "case.toml"), UserError);
}

TEST(CaseFile, AbsentFileAndFolderAreNamed)
{
    Folder const folder;
    auto const message_of = [](std::filesystem::path const& file) -> std::string
    {
        try
        {
            read_case(file);
        }
        catch (UserError const& error)
        {
            return error.what();
        }
        return "no error";
    };

    EXPECT_EQ(message_of(folder.path / "none.toml"), (folder.path / "none.toml").string() +
                                                         " cannot be read (No such file or directory); give the path "
                                                         "of a case.toml");
    EXPECT_EQ(message_of(folder.path), folder.path.string() + " is a folder (a case file is needed); give " +
                                           (folder.path / "case.toml").string());
}

TEST(CaseFile, DocumentationListsUnitRangeAndDefault)
{
    std::string const text = settings_as_markdown();

    EXPECT_THAT(text, HasSubstr("## `[[materials]]`"));
    EXPECT_THAT(text, HasSubstr("| `density` | kg/m^3 | > 0 | required | mass per volume of a particle |"));
    EXPECT_THAT(text, HasSubstr("| `schedule` |  | serial \\| overlapped \\| iterated | `\"serial\"` |"));
    EXPECT_THAT(text, HasSubstr("## `[[output.planes]]`"));
}

}  // namespace
