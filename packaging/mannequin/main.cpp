// SPDX-License-Identifier: MIT
#include "packaging/mannequin/generator.h"
#include "packaging/mannequin/glb_writer.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

namespace {

using posewire::render::Detail;

struct Output {
    Detail detail;
    const char* name;
};

constexpr std::array<Output, 3> kOutputs{{
    {Detail::Low, "mannequin_low.glb"},
    {Detail::Medium, "mannequin_medium.glb"},
    {Detail::High, "mannequin.glb"},
}};

bool write(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    return !file.fail();
}

} // namespace

/// mannequin_generator FOLDER: writes the mannequins of resources/.
int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: mannequin_generator FOLDER\n";
        return 2;
    }
    for (const Output& output : kOutputs) {
        const auto mesh = posewire::render::mannequin::generate(output.detail);
        const std::filesystem::path path = std::filesystem::path(argv[1]) / output.name;
        if (!write(path, posewire::render::mannequin::glbOf(mesh))) {
            std::cerr << "cannot write " << path << '\n';
            return 1;
        }
        std::cout << output.name << ": " << mesh.vertexCount() << " vertices, " << mesh.triangleCount()
                  << " triangles\n";
    }
    return 0;
}
