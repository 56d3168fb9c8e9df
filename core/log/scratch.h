// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <type_traits>
#include <vector>

namespace posewire::log {

struct ScratchFigures {
    std::uint64_t fileBytes = 0; ///< of the file
    std::uint64_t heapBytes = 0; ///< taken from the heap and not given back
};

/// Memory for what is kept of every packet and seldom looked at. It lies in a file without a name, which goes
/// with the process: the system writes it out where it needs the memory for others, and reads it back where
/// somebody looks. Where no file can be made, or it can grow no more, it is ordinary memory. Safe from any
/// thread; what was taken lasts as long as its last owner.
class Scratch : public std::enable_shared_from_this<Scratch> {
public:
    static constexpr std::size_t kSegment = std::size_t{16} << 20;

    /// Without a file.
    Scratch() = default;
    /// With one in a folder that exists, of at most that many bytes.
    Scratch(const std::string& folder, std::uint64_t most);
    ~Scratch();
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    /// As `new T`. Must be owned by a shared pointer itself.
    template <class T>
    [[nodiscard]] std::shared_ptr<T> make() {
        static_assert(std::is_trivially_destructible_v<T>);
        return {::new (take(sizeof(T))) T, [owner = shared_from_this()](T* used) {
                    owner->give(reinterpret_cast<std::byte*>(used), sizeof(T));
                }};
    }
    /// Not initialized; `size` is above 0.
    [[nodiscard]] std::shared_ptr<std::byte[]> bytes(std::size_t size);

    /// True if what is taken lies in a file.
    [[nodiscard]] bool hasFile() const;
    [[nodiscard]] ScratchFigures figures() const;

private:
    std::byte* take(std::size_t size);
    void give(std::byte* memory, std::size_t size);
    std::byte* grow();
    [[nodiscard]] bool isInFile(const std::byte* memory) const;

    mutable std::mutex m_mutex; ///< guards all that follows
    int m_file = -1;            ///< -1 if there is none, or it grows no more
    std::uint64_t m_most = 0;
    std::vector<std::byte*> m_segments;
    std::size_t m_used = kSegment;                          ///< of the newest segment
    std::map<std::size_t, std::vector<std::byte*>> m_spare; ///< by size
    std::uint64_t m_heapBytes = 0;
};

/// For what is kept of each packet of a file: a tenth of most files, and gone when the file is closed, so
/// that it may have half of what is free in the folder. Without a file if there is no such folder.
[[nodiscard]] std::shared_ptr<Scratch> scratchOfFile(const std::filesystem::path& folder);

} // namespace posewire::log
