// SPDX-License-Identifier: MIT
#include "core/export/motion/motion_writer.h"

#include "core/export/json_value.h"
#include "core/export/motion/scratch_column.h"
#include "core/export/motion/skeleton.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string_view>
#include <vector>

namespace posewire::exporting {
namespace {

using Eigen::Vector3d;
using List = JsonValue::array_t;

static_assert(std::endian::native == std::endian::little, "the file is, and memory is written as it is");

// Numbers of the glTF 2.0 specification.
constexpr int kUnsignedByte = 5121;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;

JsonValue vectorList(const Vector3d& vector) {
    return List{floatJson(static_cast<float>(vector.x())), floatJson(static_cast<float>(vector.y())),
                floatJson(static_cast<float>(vector.z()))};
}

template <class Element>
std::string_view bytesOf(const std::vector<Element>& elements) {
    return {reinterpret_cast<const char*>(elements.data()), elements.size() * sizeof(Element)};
}

/// Axes as the file has them.
void turnToYUp(std::vector<std::array<float, 3>>& vectors) {
    for (std::array<float, 3>& one : vectors) {
        one = model::toFloats(model::yUpFromZUp(model::toVector(one)));
    }
}

/// The keys of one joint relative to its parent. Y-up; rotations x y z w, each on the side of the one before,
/// so that players turn the short way.
struct JointKeys {
    explicit JointKeys(const std::shared_ptr<log::Scratch>& scratch)
        : positions(scratch), rotations(scratch) {}

    void addPosition(const Vector3d& zUp) { positions.add(model::toFloats(model::yUpFromZUp(zUp))); }
    void addRotation(const Eigen::Quaterniond& zUp) {
        Eigen::Quaterniond turn = model::yUpFromZUp(zUp);
        if (turn.dot(newest) < 0) {
            turn.coeffs() = -turn.coeffs();
        }
        newest = turn;
        const auto [w, x, y, z] = model::toFloats(turn);
        rotations.add(std::array{x, y, z, w});
    }

    ScratchColumn positions;
    ScratchColumn rotations;
    Eigen::Quaterniond newest = Eigen::Quaterniond::Identity();
};

/// When the keys of one character are: each later than the one before.
struct KeyTimes {
    void add(double seconds) {
        const auto time = static_cast<float>(seconds);
        first = column.size() == 0 ? time : first;
        last = column.size() == 0 || time > last
                   ? time
                   : std::nextafter(last, std::numeric_limits<float>::infinity());
        column.add(std::array{last});
    }

    ScratchColumn column;
    float first = 0;
    float last = 0;
};

/// What is in the file: the document, and the pieces of its binary part in their order.
class Document {
public:
    using Visit = std::function<void(std::string_view)>;
    using Piece = std::function<void(const Visit&)>;

    /// Adds a view with its accessor; `accessor` lacks nothing but the view. Returns the accessor's number.
    std::size_t add(std::uint64_t bytes, Piece piece, JsonValue accessor, int target = 0) {
        JsonValue view{{"buffer", 0}, {"byteOffset", m_bytes}, {"byteLength", bytes}};
        if (target != 0) {
            view["target"] = target;
        }
        m_views.push_back(std::move(view));
        accessor["bufferView"] = m_accessors.size();
        m_accessors.push_back(std::move(accessor));
        m_pieces.push_back(std::move(piece));
        m_bytes += bytes; // all of them multiples of four
        return m_accessors.size() - 1;
    }
    std::size_t addNode(JsonValue node) {
        nodes.push_back(std::move(node));
        return nodes.size() - 1;
    }
    [[nodiscard]] std::uint64_t bytes() const { return m_bytes; }
    [[nodiscard]] const List& views() const { return m_views; }
    [[nodiscard]] const List& accessors() const { return m_accessors; }
    void visit(const Visit& visit) const {
        for (const Piece& piece : m_pieces) {
            piece(visit);
        }
    }

    List nodes;
    List roots; ///< nodes of the scene
    List meshes;
    List skins;
    List materials;
    List samplers; ///< of the animation
    List channels;

private:
    List m_views;
    List m_accessors;
    std::vector<Piece> m_pieces;
    std::uint64_t m_bytes = 0;
};

/// A joint of the body that no segment is.
struct ExtraJoint {
    std::size_t place = 0;  ///< in the skeleton of the mesh
    std::size_t parent = 0; ///< in that of the character
};

/// One character in the file. Its nodes are the joints of its skeleton, then the extra ones.
struct Animated {
    Animated(const MotionTask& task, std::size_t place)
        : character(task.characterAt(place)),
          skeleton(skeletonOf(character, task.surveyAt(place), true)),
          motion(skeleton),
          times{ScratchColumn(task.source.log->scratch())} {
        slotToJoint.fill(-1);
        for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
            if (const auto segment = model::placeOf(skeleton.layout, skeleton.joints[i].position)) {
                slotToJoint[static_cast<std::size_t>(model::slotOf(*segment))] = static_cast<int>(i);
            }
        }
        if (task.makeBody && skeleton.layout.body == model::kBodySegmentCount) {
            mesh = task.makeBody(origins());
        }
        for (std::size_t i = 0; i < mesh.skeleton.size(); ++i) {
            if (!mesh.skeleton[i].name.empty()) {
                extra.push_back({i, jointOf(mesh.skeleton[i])});
            }
        }
        meshPoses.resize(mesh.skeleton.size());
        keys.assign(skeleton.joints.size() + extra.size(), JointKeys(task.source.log->scratch()));
    }

    [[nodiscard]] std::size_t jointOf(const BodyJoint& joint) const {
        return static_cast<std::size_t>(slotToJoint[static_cast<std::size_t>(joint.slot)]);
    }

    void add(const MotionFrame& frame) {
        times.add(frame.seconds);
        motion.set(*frame.pose);
        for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
            keys[i].addPosition(motion.local()[i].position);
            keys[i].addRotation(motion.local()[i].orientation);
        }
        if (!extra.empty()) {
            addExtra();
        }
    }

    const feed::PoseCharacter& character;
    Skeleton skeleton;
    JointMotion motion;
    KeyTimes times;
    std::vector<JointKeys> keys; ///< by node
    BodyMesh mesh;
    std::vector<ExtraJoint> extra;
    std::vector<std::array<float, 16>> inverseBinds;

private:
    /// The null pose that the joints make, also where none was sent.
    [[nodiscard]] SegmentPlaces origins() const {
        SegmentPlaces places;
        places.fill(Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
        std::ranges::copy(character.body().places, places.begin());
        for (std::size_t slot = 0; slot < places.size(); ++slot) {
            const int joint = slotToJoint[slot];
            const int parent = joint < 0 ? -1 : skeleton.joints[static_cast<std::size_t>(joint)].parent;
            if (parent >= 0) {
                const auto from = std::ranges::find(slotToJoint, parent) - slotToJoint.begin();
                places[slot] = places[static_cast<std::size_t>(from)] +
                               skeleton.joints[static_cast<std::size_t>(joint)].offset;
            }
        }
        return places;
    }

    void addExtra() {
        std::array<model::SegmentPose, model::kMaxSegmentCount> segments;
        for (std::size_t slot = 0; slot < segments.size(); ++slot) {
            if (slotToJoint[slot] >= 0) {
                segments[slot] = motion.world()[static_cast<std::size_t>(slotToJoint[slot])];
            }
        }
        mesh.pose(segments, meshPoses);
        for (std::size_t i = 0; i < extra.size(); ++i) {
            const model::SegmentPose local =
                model::relativeTo(motion.world()[extra[i].parent], meshPoses[extra[i].place]);
            JointKeys& node = keys[skeleton.joints.size() + i];
            if (mesh.skeleton[extra[i].place].isShifted) {
                node.addPosition(local.position);
            }
            node.addRotation(local.orientation);
        }
    }

    std::array<int, model::kMaxSegmentCount> slotToJoint{}; ///< in the skeleton; -1 if it has none
    std::vector<model::SegmentPose> meshPoses;
};

void addJoints(const Animated& one, std::size_t firstNode, Document& document, List& roots) {
    for (std::size_t i = 0; i < one.skeleton.joints.size(); ++i) {
        const SkeletonJoint& joint = one.skeleton.joints[i];
        JsonValue node{{"name", joint.name}, {"translation", vectorList(model::yUpFromZUp(joint.offset))}};
        List children;
        for (const std::size_t child : joint.children) {
            children.emplace_back(firstNode + child);
        }
        for (std::size_t k = 0; k < one.extra.size(); ++k) {
            if (one.extra[k].parent == i) {
                children.emplace_back(firstNode + one.skeleton.joints.size() + k);
            }
        }
        if (!children.empty()) {
            node["children"] = children;
        }
        const std::size_t number = document.addNode(node);
        if (joint.parent < 0) {
            roots.emplace_back(number);
        }
    }
    for (const ExtraJoint& joint : one.extra) {
        document.addNode({{"name", one.mesh.skeleton[joint.place].name}});
    }
}

void addKeys(const Animated& one, std::size_t firstNode, Document& document) {
    const auto column = [&](const ScratchColumn& floats, JsonValue accessor) {
        return document.add(
            floats.size(), [&floats](const Document::Visit& visit) { floats.visit(visit); },
            std::move(accessor));
    };
    const std::uint64_t count = one.times.column.size() / sizeof(float);
    const std::size_t times = column(one.times.column, {{"componentType", kFloat},
                                                        {"type", "SCALAR"},
                                                        {"count", count},
                                                        {"min", List{floatJson(one.times.first)}},
                                                        {"max", List{floatJson(one.times.last)}}});
    for (std::size_t i = 0; i < one.keys.size(); ++i) {
        const auto channel = [&](const char* path, const ScratchColumn& floats, const char* type) {
            const std::size_t output =
                column(floats, {{"componentType", kFloat}, {"type", type}, {"count", count}});
            document.channels.push_back({{"sampler", document.samplers.size()},
                                         {"target", JsonValue{{"node", firstNode + i}, {"path", path}}}});
            document.samplers.push_back({{"input", times}, {"interpolation", "LINEAR"}, {"output", output}});
        };
        if (one.keys[i].positions.size() != 0) {
            channel("translation", one.keys[i].positions, "VEC3");
        }
        channel("rotation", one.keys[i].rotations, "VEC4");
    }
}

JsonValue boundsOf(const std::vector<std::array<float, 3>>& positions, bool isLeast) {
    std::array<float, 3> bound = positions.front();
    for (const auto& position : positions) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            bound[axis] =
                isLeast ? std::min(bound[axis], position[axis]) : std::max(bound[axis], position[axis]);
        }
    }
    return List{floatJson(bound[0]), floatJson(bound[1]), floatJson(bound[2])};
}

/// Adds the mesh with its skin; the node that shows it.
std::size_t addBody(Animated& one, std::size_t firstNode, Document& document) {
    BodyMesh& mesh = one.mesh;
    turnToYUp(mesh.positions);
    turnToYUp(mesh.normals);
    const auto array = [&](const auto& elements, int component, const char* type, int target) {
        const std::string_view bytes = bytesOf(elements);
        JsonValue accessor{{"componentType", component}, {"type", type}, {"count", elements.size()}};
        if constexpr (std::is_same_v<decltype(elements), const std::vector<std::array<float, 3>>&>) {
            if (&elements == &mesh.positions) {
                accessor["min"] = boundsOf(elements, true);
                accessor["max"] = boundsOf(elements, false);
            }
        }
        return document.add(
            bytes.size(), [bytes](const Document::Visit& visit) { visit(bytes); }, std::move(accessor),
            target);
    };
    const std::size_t positions = array(mesh.positions, kFloat, "VEC3", kArrayBuffer);
    const std::size_t normals = array(mesh.normals, kFloat, "VEC3", kArrayBuffer);
    const std::size_t joints = array(mesh.joints, kUnsignedByte, "VEC4", kArrayBuffer);
    const std::size_t weights = array(mesh.weights, kFloat, "VEC4", kArrayBuffer);
    const std::size_t indices = array(mesh.indices, kUnsignedInt, "SCALAR", kElementArrayBuffer);
    std::size_t extra = firstNode + one.skeleton.joints.size();
    List joined;
    for (const BodyJoint& joint : mesh.skeleton) {
        const Vector3d at = model::yUpFromZUp(joint.origin);
        one.inverseBinds.push_back({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, static_cast<float>(-at.x()),
                                    static_cast<float>(-at.y()), static_cast<float>(-at.z()), 1});
        joined.emplace_back(joint.name.empty() ? firstNode + one.jointOf(joint) : extra++);
    }
    const std::size_t binds = array(one.inverseBinds, kFloat, "MAT4", 0);
    const model::Colour& colour = one.character.colour;
    document.materials.push_back(
        {{"pbrMetallicRoughness",
          JsonValue{{"baseColorFactor",
                     List{floatJson(colour.red), floatJson(colour.green), floatJson(colour.blue), 1}},
                    {"metallicFactor", 0},
                    {"roughnessFactor", 0.6}}}});
    const JsonValue attributes{
        {"POSITION", positions}, {"NORMAL", normals}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}};
    document.meshes.push_back({{"primitives", List{{{"attributes", attributes},
                                                    {"indices", indices},
                                                    {"material", document.materials.size() - 1}}}}});
    document.skins.push_back({{"inverseBindMatrices", binds}, {"skeleton", firstNode}, {"joints", joined}});
    return document.addNode(
        {{"name", "Body"}, {"mesh", document.meshes.size() - 1}, {"skin", document.skins.size() - 1}});
}

class GlbWriter final : public MotionWriter {
public:
    explicit GlbWriter(const MotionTask& task) : m_task(task) {
        for (const std::size_t place : task.characters) {
            m_characters.emplace(place, std::make_unique<Animated>(task, place));
        }
    }

    void add(const MotionFrame& frame, MotionOutput&) override {
        if (!frame.isGap()) {
            m_characters.at(frame.character)->add(frame);
        }
    }

    void finish(MotionOutput& out) override {
        Document document;
        for (const auto& [place, one] : m_characters) {
            if (one->times.column.size() != 0) {
                addCharacter(*one, document);
            }
        }
        std::string text = textOf(document);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const std::uint64_t size = kHeaders + text.size() + document.bytes();
        if (size > UINT32_MAX) {
            out.fail("a glb file cannot be larger than 4 GiB; choose a shorter range or fewer characters");
            return;
        }
        const auto word = [](std::uint64_t value) { return static_cast<std::uint32_t>(value); };
        out.write("glTF" + lowBytes(word(2), word(size), word(text.size())) + "JSON" + text +
                  lowBytes(word(document.bytes())) + std::string("BIN\0", 4));
        document.visit([&out](std::string_view bytes) { out.write(bytes); });
    }

private:
    static constexpr std::uint64_t kHeaders = 12 + 8 + 8;

    void addCharacter(Animated& one, Document& document) {
        const std::size_t firstNode = document.nodes.size();
        List children;
        addJoints(one, firstNode, document, children);
        addKeys(one, firstNode, document);
        if (!one.mesh.positions.empty()) {
            document.roots.emplace_back(addBody(one, firstNode, document));
        }
        document.roots.emplace_back(
            document.addNode({{"name", one.character.name.shown()}, {"children", children}}));
    }

    [[nodiscard]] std::string textOf(const Document& document) const {
        JsonValue file{
            {"asset", JsonValue{{"version", "2.0"}, {"generator", m_task.application}}},
            {"scene", 0},
            {"scenes", List{{{"nodes", document.roots}}}},
            {"nodes", document.nodes},
            {"animations",
             List{{{"name", "Motion"}, {"samplers", document.samplers}, {"channels", document.channels}}}}};
        for (const auto& [key, list] :
             {std::pair{"meshes", &document.meshes}, std::pair{"skins", &document.skins},
              std::pair{"materials", &document.materials}}) {
            if (!list->empty()) { // an empty list is not allowed
                file[key] = *list;
            }
        }
        file["accessors"] = document.accessors();
        file["bufferViews"] = document.views();
        file["buffers"] = List{{{"byteLength", document.bytes()}}};
        return jsonText(file);
    }

    const MotionTask& m_task;
    std::map<std::size_t, std::unique_ptr<Animated>> m_characters; ///< by place in the source
};

} // namespace

std::unique_ptr<MotionWriter> makeGlb(const MotionTask& task) {
    return std::make_unique<GlbWriter>(task);
}

} // namespace posewire::exporting
