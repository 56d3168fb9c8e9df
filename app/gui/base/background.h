// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <utility>

namespace posewire::gui {

/// True once a result is there to be taken.
template <class Result>
[[nodiscard]] bool isReady(const std::future<Result>& result) {
    return result.valid() && result.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

/// Work on a thread of its own, which says how far it is and can be cancelled.
template <class Result>
class Background {
public:
    /// To be called with a share from 0 to 1 now and then; false once the work is to end.
    using Progress = std::function<bool(double share)>;
    using Work = std::function<Result(const Progress& progress)>;

    explicit Background(Work work) {
        m_result = std::async(std::launch::async, [state = m_state, work = std::move(work)] {
            return work([&state = *state](double share) {
                state.share = share;
                return !state.isCancelled;
            });
        });
    }
    /// Waits until the work has seen that it is to end.
    ~Background() { cancel(); }

    [[nodiscard]] double share() const { return m_state->share; }
    void cancel() { m_state->isCancelled = true; }
    [[nodiscard]] bool isDone() const { return isReady(m_result); }
    /// Once, when it is done.
    [[nodiscard]] Result take() { return m_result.get(); }

private:
    struct State {
        std::atomic<double> share{0};
        std::atomic<bool> isCancelled{false};
    };
    std::shared_ptr<State> m_state = std::make_shared<State>();
    std::future<Result> m_result;
};

} // namespace posewire::gui
