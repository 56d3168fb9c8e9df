// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/standard_streams.h"
#include "render/mesh/confinement.h"
#include "render/mesh/flat_character.h"
#include "render/mesh/import.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

// posewire-import FILE: reads a foreign character file and writes it to standard output in the flat form,
// with status 0, or half a sentence that says why not, with status 1, or 2 out of time. Its one line on
// standard error names its confinement.
namespace {

using namespace posewire;

[[noreturn]] void end(std::string_view output, int status) {
    static_cast<void>(std::fwrite(output.data(), 1, output.size(), stdout));
    std::_Exit(std::fflush(stdout) == 0 ? status : 3);
}

} // namespace

int main(int count, char** arguments) {
    system::prepareStandardStreams();
    system::leaveFailedWritesToTheWriter();
    const std::string file = count == 2 ? system::argumentsOf(count, arguments)[1] : "";
    if (file.empty() || file == "--version" || file == "-v") {
        end(file.empty() ? "usage: posewire-import FILE" : render::importerName(), file.empty() ? 3 : 0);
    }
    std::error_code problem;
    const std::filesystem::path whole = std::filesystem::canonical(file, problem);
    render::limitThisProcess("reading it takes too long");
    std::fprintf(stderr, "%s\n", render::confineTo(whole.parent_path().string()).c_str());
    const auto character = render::importCharacter(whole.empty() ? file : whole.string());
    if (!character) {
        end(character.error(), 1);
    }
    const std::vector<std::byte> flat = render::flatten(*character);
    end({reinterpret_cast<const char*>(flat.data()), flat.size()}, 0);
}
