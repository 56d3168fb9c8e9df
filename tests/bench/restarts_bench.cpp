// SPDX-License-Identifier: MIT
#include "core/log/packet_log.h"
#include "core/model/session/session.h"
#include "core/model/session/verdict.h"
#include "core/performer/performer.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

// What does the verdict cost after 10,000 restarts of a sender of four characters, each on another port and
// too soon for silence to tell them apart, against that of one that never restarted? Both are judged anew
// for each refresh of the window; medians.
//   restarts_bench [--brief] [--check]
namespace {

using namespace posewire;

constexpr double kLimit = 200.0; // times the verdict of a sender that never restarted
constexpr int kSamples = 3;      // of each life of the sender

class Stage {
public:
    void perform(int restarts) {
        performer::Performer performer({.characters = 4, .rateHz = 240, .types = {2}});
        for (int life = 0; life <= restarts; ++life) {
            const log::SenderId sender =
                m_log.senders().intern({"10.0.0.1:" + std::to_string(life), log::Transport::Udp, 9763});
            for (int sample = 0; sample < kSamples; ++sample, m_at += std::chrono::milliseconds(4)) {
                for (const wire::Datagram& datagram : performer.frame(static_cast<std::uint64_t>(sample))) {
                    m_log.writer().append(*wire::encode(datagram), {.stamp = m_at, .sender = sender});
                }
            }
            m_log.writer().publish();
            m_session.follow(m_at);
        }
    }

    /// Microseconds.
    double refresh() {
        m_at += std::chrono::milliseconds(16);
        m_session.follow(m_at);
        const auto start = std::chrono::steady_clock::now();
        const bool isBad = m_session.verdicts().all().all.state == model::TakeVerdict::State::Bad;
        const std::chrono::duration<double, std::micro> lasted = std::chrono::steady_clock::now() - start;
        m_bad += isBad ? 1 : 0;
        return lasted.count();
    }

private:
    log::PacketLog m_log;
    model::Session m_session{m_log};
    log::Stamp m_at{std::chrono::seconds(1'000)};
    int m_bad = 0;
};

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

} // namespace

int main(int argumentCount, char** arguments) {
    const std::vector<std::string_view> options(arguments + 1, arguments + argumentCount);
    const bool isBrief = std::ranges::count(options, "--brief") != 0;
    Stage steady;
    steady.perform(0);
    Stage restarted;
    restarted.perform(isBrief ? 500 : 10'000);
    std::vector<double> floors;
    std::vector<double> costs;
    for (int round = 0; round < (isBrief ? 5 : 101); ++round) {
        floors.push_back(steady.refresh());
        costs.push_back(restarted.refresh());
    }
    const double ratio = median(costs) / median(floors);
    std::printf("# verdict %.1f us, after restarts %.1f us\n", median(floors), median(costs));
    std::printf("verdict_restarts %.2f %.1f\n", ratio, kLimit);
    return std::ranges::count(options, "--check") != 0 && ratio > kLimit ? 1 : 0;
}
