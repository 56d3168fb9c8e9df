// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace posewire::render::gl {

/// What is written anew for each view of a picture, of which a picture may have `views`: those of the
/// pictures that the driver may still be drawing, and of the next, so that writing waits for none.
template <typename T, std::size_t views>
class Ring {
public:
    static constexpr std::size_t kPictures = 3;

    /// Makes each by `make`.
    template <typename Make>
    explicit Ring(Make&& make) {
        for (T& one : m_all) {
            one = make();
        }
    }

    /// That which was written longest ago, to be written; it is current() from then on.
    T& next() {
        m_current = (m_current + 1) % m_all.size();
        return m_all[m_current];
    }
    const T& current() const { return m_all[m_current]; }

private:
    std::array<T, kPictures * views> m_all;
    std::size_t m_current = 0;
};

} // namespace posewire::render::gl
