// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace posewire::exporting {

/// The parameter section of a C3D file, byte by byte in Intel order. Groups are numbered as they are begun;
/// parameters belong to the newest one.
class C3dParameters {
public:
    static constexpr std::size_t kBlock = 512;
    static constexpr std::size_t kMostText = 127; ///< bytes

    void beginGroup(std::string_view name);
    void add(std::string_view name, std::span<const std::int16_t> values);
    void add(std::string_view name, float value);
    /// One text, or several of the length of the longest; at most 255. Longer texts are clipped.
    void add(std::string_view name, std::span<const std::string> texts);
    void add(std::string_view name, std::string_view text);

    /// Whole blocks.
    [[nodiscard]] std::string section() const;
    /// How many blocks these are.
    [[nodiscard]] std::size_t blocks() const;

private:
    void addItem(std::string_view name, std::int8_t group, std::string_view content);

    std::string m_items;
    std::int8_t m_group = 0;
};

/// Intel order.
void appendC3d(std::int16_t value, std::string& bytes);
void appendC3d(float value, std::string& bytes);

} // namespace posewire::exporting
