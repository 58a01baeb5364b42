// SPDX-License-Identifier: BSD-3-Clause
/// main() of a fuzz target where the compiler has no libFuzzer: runs the target on each file of the given files and
/// folders, once, and then on changed copies of them. Options as libFuzzer has them: -max_total_time, -runs, -seed.
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size);

namespace
{

using Input = std::vector<std::uint8_t>;

Input read(std::filesystem::path const& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<Input> read_all(std::filesystem::path const& place)
{
    if (!std::filesystem::is_directory(place)) return {read(place)};
    std::vector<Input> inputs;
    for (auto const& file : std::filesystem::directory_iterator(place))
        inputs.push_back(read(file));
    return inputs;
}

/// A few bytes other, gone, or more.
void change(Input& input, std::mt19937_64& random)
{
    for (auto changes = 1 + random() % 4; changes > 0; --changes)
    {
        std::size_t const at = input.empty() ? 0 : random() % input.size();
        auto const place = input.begin() + static_cast<std::ptrdiff_t>(at);
        auto const byte = static_cast<std::uint8_t>(random());
        if (input.empty() || random() % 4 == 0)
            input.insert(place, byte);
        else if (random() % 4 == 0)
            input.erase(place);
        else
            *place = byte;
    }
}

double value_of(std::string const& option)
{
    return std::stod(option.substr(option.find('=') + 1));
}

}  // namespace

int main(int argc, char** argv)
{
    std::vector<Input> inputs;
    double seconds = 0;
    double runs = 0;
    std::mt19937_64 random(1);
    for (std::string const& word : std::vector<std::string>(argv + 1, argv + argc))
    {
        if (word.rfind("-max_total_time=", 0) == 0) seconds = value_of(word);
        if (word.rfind("-runs=", 0) == 0) runs = value_of(word);
        if (word.rfind("-seed=", 0) == 0) random.seed(static_cast<std::uint64_t>(value_of(word)));
        if (word.rfind('-', 0) == 0) continue;
        for (Input& input : read_all(word))
            inputs.push_back(std::move(input));
    }

    auto const start = std::chrono::steady_clock::now();
    double done = 0;
    for (Input const& input : inputs)
        LLVMFuzzerTestOneInput(input.data(), input.size()), ++done;
    auto const time = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
    while (!inputs.empty() && (time() < seconds || done < runs))
    {
        Input input = inputs[random() % inputs.size()];
        change(input, random);
        LLVMFuzzerTestOneInput(input.data(), input.size()), ++done;
    }
    std::cerr << "stat::number_of_executed_units: " << static_cast<std::uint64_t>(done) << '\n';
    return 0;
}
