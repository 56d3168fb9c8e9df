// SPDX-License-Identifier: MIT
#include "core/export/motion/motion_writer.h"
#include "core/export/motion/scratch_column.h"
#include "core/export/motion/skeleton.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <limits>
#include <system_error>

namespace posewire::exporting {
namespace {

/// Numbers of arrays are as this computer has them; those of the archive begin with the low byte.
constexpr char kByteOrder = std::endian::native == std::endian::little ? '<' : '>';

/// An array in the format of numpy (NEP 1, version 1.0), kept in scratch memory until the file ends.
class NumpyArray {
public:
    /// `type` as numpy writes it, without the order of bytes; `shape` behind the number of rows: ", 23, 3".
    NumpyArray(std::string name, std::string type, std::string shape, std::shared_ptr<log::Scratch> scratch)
        : m_name(std::move(name)),
          m_type(std::move(type)),
          m_shape(std::move(shape)),
          m_values(std::move(scratch)) {}

    template <class Number>
    void addRow(const std::vector<Number>& row) {
        ++m_rows;
        m_values.add(row);
    }
    template <class Number>
    void add(Number number) {
        ++m_rows;
        m_values.add(std::array{number});
    }
    /// Adds a row for each text of ASCII, which `type` has room for.
    void addTexts(std::span<const std::string_view> texts, std::size_t room) {
        for (const std::string_view text : texts) {
            std::vector<char32_t> letters(room);
            std::ranges::copy(text, letters.begin());
            addRow(letters);
        }
    }

    [[nodiscard]] std::string fileName() const { return m_name + ".npy"; }
    /// Returns the header of its file.
    [[nodiscard]] std::string head() const {
        constexpr std::size_t kAlignment = 64;
        constexpr std::size_t kBefore = 10;
        std::string text = std::string("{'descr': '") + (m_type == "u1" ? '|' : kByteOrder) + m_type +
                           "', 'fortran_order': False, 'shape': (" + std::to_string(m_rows) +
                           (m_shape.empty() ? "," : m_shape) + "), }";
        const std::size_t size = kBefore + text.size() + 1;
        text.append((kAlignment - size % kAlignment) % kAlignment, ' ');
        return std::string("\x93NUMPY\x01\0", 8) + lowBytes(static_cast<std::uint16_t>(text.size() + 1)) +
               text + '\n';
    }
    [[nodiscard]] const ScratchColumn& values() const { return m_values; }

private:
    std::string m_name;
    std::string m_type;
    std::string m_shape;
    ScratchColumn m_values;
    std::uint64_t m_rows = 0;
};

/// A zip archive of files that are stored as they are, with the sizes of ZIP64 (PKWARE APPNOTE 6.3.3, 4.3).
class ZipArchive {
public:
    explicit ZipArchive(MotionOutput& out) : m_out(out) {}

    void add(const NumpyArray& array) {
        const std::string head = array.head();
        auto crc = crc32_z(0, reinterpret_cast<const Bytef*>(head.data()), head.size());
        array.values().visit([&crc](std::string_view piece) {
            crc = crc32_z(crc, reinterpret_cast<const Bytef*>(piece.data()), piece.size());
        });
        const std::uint64_t size = head.size() + array.values().size();
        const std::string name = array.fileName();
        m_directory += lowBytes(Word{0x02014b50}, kVersion) + entry(name, crc, 28) +
                       std::string(10, '\0') + // no comment, the first disk, no attributes
                       lowBytes(kIn64) + name + sizes(size, 24) + lowBytes(m_written);
        ++m_count;
        write(lowBytes(Word{0x04034b50}) + entry(name, crc, 20) + name + sizes(size, 16) + head);
        array.values().visit([this](std::string_view piece) { write(piece); });
    }

    void finish() {
        const std::uint64_t begin = m_written;
        const std::uint64_t size = m_directory.size();
        write(m_directory);
        const auto count = static_cast<Half>(m_count);
        write(lowBytes(Word{0x06064b50}, std::uint64_t{44}, kVersion, kVersion, Word{}, Word{}, m_count,
                       m_count, size, begin) +
              lowBytes(Word{0x07064b50}, Word{}, begin + size, Word{1}) +
              lowBytes(Word{0x06054b50}, Word{}, count, count, kIn64, kIn64, Half{}));
    }

private:
    using Half = std::uint16_t;
    using Word = std::uint32_t;
    static constexpr Half kVersion = 45; ///< that ZIP64 came with
    static constexpr Word kIn64 = 0xffffffff;

    /// Returns the part that a file's own header and the directory share.
    static std::string entry(const std::string& name, std::uint64_t crc, Half extra) {
        constexpr Half kFirstDay = 0x21;                  // of 1980: the same motion makes the same bytes
        return lowBytes(kVersion, Half{}, Half{}, Half{}, // no flags, stored, at midnight
                        kFirstDay, static_cast<Word>(crc), kIn64, kIn64, static_cast<Half>(name.size()),
                        extra);
    }
    /// Returns an extra field of ZIP64 of a length, filled with sizes alone.
    static std::string sizes(std::uint64_t size, Half field) { return lowBytes(Half{1}, field, size, size); }
    void write(std::string_view bytes) {
        m_out.write(bytes);
        m_written += bytes.size();
    }

    MotionOutput& m_out;
    std::string m_directory;
    std::uint64_t m_written = 0;
    std::uint64_t m_count = 0;
};

std::shared_ptr<log::Scratch> temporaryScratch() {
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
    return error ? std::make_shared<log::Scratch>() : log::scratchOfFile(folder);
}

class NumpyWriter final : public MotionWriter {
public:
    explicit NumpyWriter(const MotionTask& task)
        : m_task(task), m_layout(task.surveyAt(task.characters.front()).layout) {}

    void add(const MotionFrame& frame, MotionOutput&) override {
        m_time.add(frame.seconds);
        m_sample.add(frame.sample);
        m_run.add(static_cast<std::uint32_t>(frame.run));
        const auto receipt = m_task.receiptOf(frame);
        m_received.add(receipt ? static_cast<std::int64_t>(log::nanosecondsOf(*receipt)) : kMissing);
        m_timeOfDay.add(frame.timeOfDay ? std::int64_t{frame.timeOfDay->milliseconds()} : kMissing);
        m_timeCode.add(frame.isGap() ? kMissing : std::int64_t{frame.pose->timeCode});
        m_type.add(frame.isGap() ? std::uint8_t{0} : frame.pose->type);
        m_positions.assign(3 * m_segments, std::numeric_limits<float>::quiet_NaN());
        m_orientations.assign(4 * m_segments, std::numeric_limits<float>::quiet_NaN());
        m_sources.assign(m_segments, 0);
        for (std::size_t i = 0; !frame.isGap() && i < m_segments; ++i) {
            addSegment(*frame.pose, i);
        }
        m_position.addRow(m_positions);
        m_orientation.addRow(m_orientations);
        m_provenance.addRow(m_sources);
    }

    void finish(MotionOutput& out) override {
        std::vector<std::string_view> names;
        for (std::size_t i = 0; i < m_segments; ++i) {
            names.push_back(model::segmentName(m_layout, static_cast<int>(i)));
        }
        m_names.addTexts(names, kLongestName);
        m_provenanceNames.addTexts(kProvenanceNames, kLongestName);
        ZipArchive archive(out);
        for (const NumpyArray* array :
             {&m_time, &m_position, &m_orientation, &m_provenance, &m_names, &m_provenanceNames, &m_sample,
              &m_run, &m_timeCode, &m_received, &m_type}) {
            archive.add(*array);
        }
        if (m_task.hasTimeOfDay()) {
            archive.add(m_timeOfDay);
        }
        archive.finish();
    }

private:
    static constexpr std::int64_t kMissing = -1;
    static constexpr std::size_t kLongestName = 16;

    void addSegment(const model::CharacterPose& pose, std::size_t column) {
        const model::SegmentPose* segment = poseAt(pose, m_layout, static_cast<int>(column));
        if (segment == nullptr) {
            return;
        }
        const Eigen::Vector3f at = segment->position.cast<float>();
        const Eigen::Quaternionf turn = segment->orientation.cast<float>();
        std::ranges::copy(std::array{at.x(), at.y(), at.z()}, &m_positions[3 * column]);
        std::ranges::copy(std::array{turn.w(), turn.x(), turn.y(), turn.z()}, &m_orientations[4 * column]);
        m_sources[column] = static_cast<std::uint8_t>(provenanceAt(pose, m_layout, static_cast<int>(column)));
    }
    NumpyArray array(std::string name, std::string type, std::string shape = {}) const {
        return {std::move(name), std::move(type), std::move(shape), m_scratch};
    }

    const MotionTask& m_task;
    model::SegmentLayout m_layout;
    std::size_t m_segments = static_cast<std::size_t>(m_layout.count());
    std::shared_ptr<log::Scratch> m_scratch = temporaryScratch();
    std::string m_columns = ", " + std::to_string(m_segments);
    NumpyArray m_time = array("time", "f8");
    NumpyArray m_position = array("position", "f4", m_columns + ", 3");
    NumpyArray m_orientation = array("orientation", "f4", m_columns + ", 4");
    NumpyArray m_provenance = array("provenance", "u1", m_columns);
    NumpyArray m_names = array("names", "U16");
    NumpyArray m_provenanceNames = array("provenance_names", "U16");
    NumpyArray m_sample = array("sample", "u4");
    NumpyArray m_run = array("run", "u4");
    NumpyArray m_timeCode = array("time_code_ms", "i8");
    NumpyArray m_received = array("received_ns", "i8");
    NumpyArray m_type = array("type", "u1");
    NumpyArray m_timeOfDay = array("time_of_day_ms", "i8");
    std::vector<float> m_positions; ///< of a frame
    std::vector<float> m_orientations;
    std::vector<std::uint8_t> m_sources;
};

} // namespace

std::unique_ptr<MotionWriter> makeNumpy(const MotionTask& task) {
    return std::make_unique<NumpyWriter>(task);
}

} // namespace posewire::exporting
