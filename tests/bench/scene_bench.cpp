// SPDX-License-Identifier: GPL-3.0-or-later
// What the window's thread takes to prepare a picture of 20 characters that are received: their newest poses,
// palettes and looks, a camera that follows, and the texts and places of their labels. The floor is moving
// 52,000 points by a rigid motion, a millisecond where the limit was set.
//   scene_bench [--check] [--brief]
#include "app/gui/viewport/camera_motion.h"
#include "app/gui/viewport/picking.h"
#include "app/gui/viewport/scene.h"
#include "tests/app/gui/models/stage.h"

#include <QApplication>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <vector>

namespace {

using namespace posewire;
using namespace posewire::gui;

constexpr int kCharacters = 20;
constexpr double kLimit = 1.0;
constexpr float kAspect = 16.0F / 9.0F;

double threadCpuMs() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

double floorMs() {
    const render::DualQuaternion motion{{0.1F, 0.2F, 0.3F, 0.927F}, {0.4F, 0.1F, 0.2F, 0.0F}};
    const double begin = threadCpuMs();
    glm::vec3 point{0.3F, 0.2F, 0.1F};
    for (int i = 0; i < 52'000; ++i) {
        point = glm::fract(render::transformPoint(motion, point));
    }
    asm volatile("" : : "r"(&point) : "memory");
    return threadCpuMs() - begin;
}

/// What a new scale message costs: milliseconds to fit a body that was not there before.
double refitMs() {
    constexpr int kBodies = 200;
    BodyFits bodies(render::Detail::Medium);
    render::NullPose performer = render::kReferenceNullPose;
    static_cast<void>(bodies.of(performer)); // loads the mannequin
    const double begin = threadCpuMs();
    for (int i = 0; i < kBodies; ++i) {
        performer[render::Head].z += 0.0001F;
        static_cast<void>(bodies.of(performer));
    }
    return (threadCpuMs() - begin) / kBodies;
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

struct Costs {
    double poses = 0;
    double camera = 0;
    double labels = 0;
    std::size_t characters = 0;
};

Costs prepare(Stage& stage, SceneBuilder& builder, CameraMotion& motion) {
    Costs costs;
    const double begin = threadCpuMs();
    SceneFrame frame;
    builder.build(AxesMode::All, {}, frame);
    const double built = threadCpuMs();
    std::vector<render::Bounds> boxes;
    for (const Figure& figure : frame.figures) {
        boxes.push_back(figure.bounds);
    }
    motion.follow(boxes, kAspect, 0.016);
    const double followed = threadCpuMs();
    std::size_t letters = 0;
    frame.camera = motion.camera();
    for (const ViewportLabel& label : labelsOf(frame, stage.session, {1280, 720})) {
        letters += static_cast<std::size_t>(label.name.size() + label.state.text.size());
    }
    asm volatile("" : : "r"(letters) : "memory");
    costs.characters = frame.figures.size();
    costs.poses = built - begin;
    costs.camera = followed - built;
    costs.labels = threadCpuMs() - followed;
    return costs;
}

} // namespace

int main(int argc, char** argv) {
    const QApplication application(argc, argv);
    bool isChecked = false;
    int pictures = 300;
    for (int i = 1; i < argc; ++i) {
        isChecked |= std::strcmp(argv[i], "--check") == 0;
        pictures = std::strcmp(argv[i], "--brief") == 0 ? 5 : pictures;
    }
    Stage stage;
    performer::Performer performer(sending(kCharacters, {2, 12, 13}, 60.0));
    SceneBuilder builder(stage.session, render::Detail::Medium);
    CameraMotion motion;
    std::vector<double> totals;
    std::vector<double> poses;
    std::vector<double> cameras;
    std::vector<double> labels;
    std::vector<double> floors;
    constexpr int kWarmUp = 20;
    for (int picture = 0; picture < kWarmUp + pictures; ++picture) {
        const auto sample = static_cast<std::uint64_t>(picture);
        stage.perform(performer, sample, sample + 1);
        stage.follow();
        const Costs costs = prepare(stage, builder, motion);
        if (picture >= kWarmUp) {
            if (costs.characters != kCharacters) {
                std::fprintf(stderr, "scene_bench: %zu characters are shown\n", costs.characters);
                return 2;
            }
            totals.push_back(costs.poses + costs.camera + costs.labels);
            poses.push_back(costs.poses);
            cameras.push_back(costs.camera);
            labels.push_back(costs.labels);
            floors.push_back(floorMs());
        }
    }
    const double ratio = median(totals) / median(floors);
    std::printf(
        "# %d characters: %.3f ms a picture, of it poses and palettes %.3f, camera %.3f, labels %.3f; the "
        "floor %.3f ms\n",
        kCharacters, median(totals), median(poses), median(cameras), median(labels), median(floors));
    std::printf("# %.4f ms to fit a body anew\n", refitMs());
    std::printf("scene_20 %.3f %.3f\n", ratio, kLimit);
    return isChecked && ratio > kLimit ? 1 : 0;
}
