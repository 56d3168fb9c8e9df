// SPDX-License-Identifier: MIT
// Fails where a picture allocates anything.
// CPU time of all threads for one picture at 1280 x 720 by software OpenGL, read back included: 1, 2, 4 and
// 20 characters that move, with their axes, before a camera that holds, and four before one that turns; on
// the step that the ladder finds by the time that pictures take, or with --steps on each. The floor is moving
// one point by a rigid motion for each pixel.
//   render_bench [--check] [--brief] [--steps]
#include "render/mesh/mannequin.h"
#include "render/offscreen.h"
#include "render/quality_ladder.h"
#include "tests/render/poses.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <map>
#include <new>
#include <string>
#include <vector>

namespace {

/// By operator new, since the start.
std::size_t allocations = 0;

} // namespace

void* operator new(std::size_t size) {
    ++allocations;
    if (void* room = std::malloc(size); room != nullptr) {
        return room;
    }
    throw std::bad_alloc();
}
void operator delete(void* room) noexcept {
    std::free(room);
}
void operator delete(void* room, std::size_t /*size*/) noexcept {
    std::free(room);
}

namespace {

using namespace posewire::render;
using posewire::render::test::Pose;

constexpr int kWidth = 1280;
constexpr int kHeight = 720;

/// Of all threads of this process.
double cpuMs() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

double floorMs() {
    const DualQuaternion motion{{0.1F, 0.2F, 0.3F, 0.927F}, {0.4F, 0.1F, 0.2F, 0.0F}};
    const double begin = cpuMs();
    glm::vec3 point{0.3F, 0.2F, 0.1F};
    for (int i = 0; i < kWidth * kHeight; ++i) {
        point = glm::fract(transformPoint(motion, point));
    }
    asm volatile("" : : "r"(&point) : "memory");
    return cpuMs() - begin;
}

/// Arms and legs swing, each character at a moment of its own.
Pose walking(int character, int picture) {
    const float phase = 0.09F * static_cast<float>(picture) + 1.7F * static_cast<float>(character);
    const float swing = 0.5F * std::sin(phase);
    const auto about = [](float angle, const glm::vec3& axis) { return glm::angleAxis(angle, axis); };
    const glm::vec3 x(1, 0, 0);
    const glm::vec3 y(0, 1, 0);
    return test::poseFrom({{LeftUpperArm, about(swing, y) * about(-1.2F, x)},
                           {RightUpperArm, about(-swing, y) * about(1.2F, x)},
                           {LeftForeArm, about(-0.4F, y)},
                           {RightForeArm, about(-0.4F, y)},
                           {LeftUpperLeg, about(-swing, y)},
                           {RightUpperLeg, about(swing, y)},
                           {LeftLowerLeg, about(std::max(swing, 0.0F), y)},
                           {RightLowerLeg, about(std::max(-swing, 0.0F), y)},
                           {T8, about(0.3F * swing, glm::vec3(0, 0, 1))}});
}

class Stage {
public:
    explicit Stage(int count) : m_count(count), m_characters(static_cast<std::size_t>(count)) {
        Bounds all;
        for (int i = 0; i < count; ++i) {
            all.add(place(i) + glm::vec3(-0.4F, -0.4F, 0.0F));
            all.add(place(i) + glm::vec3(0.4F, 0.4F, 1.9F));
            m_characters[static_cast<std::size_t>(i)].look.colour = {0.2F + 0.03F * static_cast<float>(i),
                                                                     0.45F, 0.7F};
        }
        scene.camera.yaw = 0.25F;
        scene.camera.frame(all, static_cast<float>(kWidth) / static_cast<float>(kHeight));
        scene.light = keyLight(scene.camera);
        scene.colours = darkSceneColours();
        m_palettes.resize(m_characters.size());
    }

    void use(MeshId mesh, MeshId low) {
        for (SkinnedInstance& character : m_characters) {
            character.mesh = mesh;
            character.lowMesh = low;
        }
    }

    void move(int picture, bool isTurning, bool hasAxes) {
        if (isTurning) {
            scene.camera.orbit(0.01F, 0.0F);
            scene.light = keyLight(scene.camera);
        }
        m_axes.clear();
        for (int i = 0; i < m_count; ++i) {
            const auto index = static_cast<std::size_t>(i);
            const Pose pose = test::placed(walking(i, picture), place(i));
            m_palettes[index] = test::paletteOf(pose);
            m_characters[index].palette = m_palettes[index];
            for (std::size_t segment = 0; hasAxes && segment < kSegmentCount; ++segment) {
                m_axes.push_back({pose.positions[segment], pose.orientations[segment], 0.12F, 0.85F});
            }
        }
        scene.characters = m_characters;
        scene.axes = m_axes;
    }

    Scene scene;

private:
    /// In rows of five.
    glm::vec3 place(int character) const {
        const int across = std::min(m_count, 5);
        return {-1.3F * static_cast<float>(character / 5),
                1.1F * (static_cast<float>(character % 5) - 0.5F * static_cast<float>(across - 1)), 0.0F};
    }

    int m_count;
    std::vector<SkinnedInstance> m_characters;
    std::vector<std::vector<DualQuaternion>> m_palettes;
    std::vector<AxesInstance> m_axes;
};

struct Case {
    const char* name;
    int characters;
    bool isTurning;
    double limitMs; ///< on the computer that the limits were set on, where the floor took kFloorMs
};

constexpr double kFloorMs = 17.5;
constexpr Case kCases[] = {{"render_1", 1, false, 35},
                           {"render_2", 2, false, 35},
                           {"render_4", 4, false, 35},
                           {"render_20", 20, false, 90},
                           {"render_4_turning", 4, true, 45}};

/// Draws as the window does where the processor draws.
class Drawing {
public:
    Drawing(const Case& wanted, OffscreenRenderer& offscreen, MeshId mesh, MeshId low)
        : m_case(wanted),
          m_offscreen(offscreen),
          m_stage(wanted.characters),
          m_interactive(interactiveQuality(offscreen.renderer().rendererName())) {
        m_stage.use(mesh, low);
    }

    void setStep(Simplification step) {
        m_step = step;
        RenderQuality quality = simplified(m_interactive, step);
        quality.plainFloor = m_case.isTurning;
        m_offscreen.renderer().setQuality(quality);
    }

    /// Milliseconds of CPU.
    double draw() {
        m_stage.move(++m_picture, m_case.isTurning, m_step < Simplification::FewAxes);
        const double before = cpuMs();
        m_offscreen.render(m_stage.scene, kWidth, kHeight);
        return cpuMs() - before;
    }

    /// Draws until the ladder has had time to find its step.
    void settle(int pictures) {
        QualityLadder ladder;
        for (int i = 0; i < pictures; ++i) {
            setStep(ladder.step());
            const auto before = std::chrono::steady_clock::now();
            draw();
            const auto after = std::chrono::steady_clock::now();
            ladder.add(std::chrono::duration<double>(after - before).count(),
                       std::chrono::duration<double>(after.time_since_epoch()).count());
        }
        setStep(ladder.step());
        std::printf("# %d characters%s: step %d of %d, %.1f ms a picture\n", m_case.characters,
                    m_case.isTurning ? ", the camera turns" : "", static_cast<int>(ladder.step()),
                    kLastSimplification, 1e3 * ladder.typical());
    }

    std::size_t printPasses(int pictures) {
        std::vector<std::string> order;
        std::map<std::string, std::vector<double>, std::less<>> costs;
        double before = 0.0;
        const auto passed = [&](std::string_view name) {
            const double now = cpuMs();
            auto found = costs.find(name);
            if (found == costs.end()) {
                order.emplace_back(name);
                found = costs.try_emplace(order.back()).first;
            }
            found->second.push_back(now - before);
            before = now;
        };
        m_offscreen.renderer().observePasses(passed);
        for (int picture = 0; picture < pictures; ++picture) {
            m_stage.move(++m_picture, m_case.isTurning, m_step < Simplification::FewAxes);
            before = cpuMs();
            m_offscreen.render(m_stage.scene, kWidth, kHeight);
            passed("read back");
        }
        m_offscreen.renderer().observePasses({});
        std::printf("#  ");
        for (const std::string& name : order) {
            std::printf(" %s %.1f,", name.c_str(), median(costs[name]));
        }
        const std::size_t made = allocationsOfOne();
        std::printf(" with %zu allocations\n", made);
        return made;
    }

private:
    std::size_t allocationsOfOne() {
        m_stage.move(++m_picture, m_case.isTurning, m_step < Simplification::FewAxes);
        const std::size_t before = allocations;
        m_offscreen.renderer().draw(m_stage.scene, {kWidth, kHeight, 0, 1.0F});
        return allocations - before;
    }

    const Case& m_case;
    OffscreenRenderer& m_offscreen;
    Stage m_stage;
    RenderQuality m_interactive;
    Simplification m_step = Simplification::None;
    int m_picture = 0;
};

struct Options {
    int pictures = 60;
    bool isChecked = false;
    bool isOfEachStep = false;
};

int run(const Case& wanted, Drawing& drawing, const Options& options) {
    drawing.settle(2 * options.pictures);
    std::vector<double> costs;
    std::vector<double> floors;
    for (int picture = 0; picture < options.pictures; ++picture) {
        costs.push_back(drawing.draw());
        floors.push_back(floorMs());
    }
    const double ratio = median(costs) / median(floors);
    std::printf("#   %.1f ms of CPU a picture, the floor %.1f ms\n", median(costs), median(floors));
    const std::size_t made = drawing.printPasses(std::max(options.pictures / 2, 1));
    std::printf("%s %.2f %.2f\n", wanted.name, ratio, wanted.limitMs / kFloorMs);
    const bool isSlow = options.isChecked && ratio > wanted.limitMs / kFloorMs;
    return isSlow || made != 0 ? 1 : 0; // a picture allocates nothing, however busy the computer is
}

void printSteps(const Case& wanted, Drawing& drawing, const Options& options) {
    std::printf("# %s, ms of CPU on each step:", wanted.name);
    for (int step = 0; step < kLastSimplification; ++step) {
        drawing.setStep(static_cast<Simplification>(step));
        std::vector<double> costs;
        for (int picture = 0; picture < options.pictures; ++picture) {
            costs.push_back(drawing.draw());
        }
        std::printf(" %.1f", median(costs));
    }
    std::printf("\n");
}

} // namespace

int main(int argumentCount, char** arguments) {
    Options options;
    for (int i = 1; i < argumentCount; ++i) {
        options.isChecked |= std::strcmp(arguments[i], "--check") == 0;
        options.isOfEachStep |= std::strcmp(arguments[i], "--steps") == 0;
        options.pictures = std::strcmp(arguments[i], "--brief") == 0 ? 3 : options.pictures;
    }
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    auto offscreen = OffscreenRenderer::create();
    if (!offscreen) {
        std::fprintf(stderr, "render_bench: %s\n", offscreen.error().c_str());
        return 2;
    }
    const auto upload = [&](Detail detail) {
        const SkinnedMesh mesh = loadMannequin(detail);
        return offscreen->renderer().uploadMesh(mesh);
    };
    const MeshId medium = upload(Detail::Medium);
    const MeshId low = upload(Detail::Low);
    std::printf("# %s\n", offscreen->renderer().rendererName().c_str());
    int failed = 0;
    for (const Case& wanted : kCases) {
        Drawing drawing(wanted, *offscreen, medium, low);
        if (options.isOfEachStep) {
            printSteps(wanted, drawing, options);
        } else {
            failed |= run(wanted, drawing, options);
        }
    }
    return failed;
}
