// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <map>
#include <string>

namespace posewire::exporting {

/// An animation as assimp reads it: an independent reader.
class ImportedMotion {
public:
    explicit ImportedMotion(const std::string& path) {
        m_scene = m_importer.ReadFile(path, aiProcess_ValidateDataStructure);
    }

    [[nodiscard]] const aiScene* scene() const { return m_scene; }
    [[nodiscard]] std::string problem() const { return m_importer.GetErrorString(); }
    [[nodiscard]] const aiAnimation* animation() const {
        return m_scene != nullptr && m_scene->mNumAnimations == 1 ? m_scene->mAnimations[0] : nullptr;
    }

    /// The node of that name, the one below `under` where that is not null.
    [[nodiscard]] const aiNode* node(const std::string& name, const aiNode* under = nullptr) const {
        return (under != nullptr ? under : m_scene->mRootNode)->FindNode(name.c_str());
    }
    /// Where a node is at a key, in the file's frame and unit.
    [[nodiscard]] Eigen::Affine3d worldOf(const aiNode* node, unsigned key) const {
        Eigen::Affine3d world = Eigen::Affine3d::Identity();
        for (; node != nullptr; node = node->mParent) {
            world = localOf(*node, key) * world;
        }
        return world;
    }
    [[nodiscard]] const aiNodeAnim* channelOf(const aiNode& node) const {
        for (unsigned i = 0; i < animation()->mNumChannels; ++i) {
            if (animation()->mChannels[i]->mNodeName == node.mName) {
                return animation()->mChannels[i];
            }
        }
        return nullptr;
    }

private:
    [[nodiscard]] Eigen::Affine3d localOf(const aiNode& node, unsigned key) const {
        const aiNodeAnim* channel = channelOf(node);
        const aiMatrix4x4& m = node.mTransformation;
        Eigen::Affine3d local;
        local.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2,
            m.d3, m.d4;
        if (channel == nullptr) {
            return local;
        }
        Eigen::Vector3d position = local.translation();
        if (channel->mNumPositionKeys > 1) {
            const aiVector3D& at = channel->mPositionKeys[key].mValue;
            position = {at.x, at.y, at.z};
        }
        const aiQuaternion& turn = channel->mRotationKeys[channel->mNumRotationKeys > 1 ? key : 0].mValue;
        return Eigen::Translation3d(position) * Eigen::Quaterniond(turn.w, turn.x, turn.y, turn.z);
    }

    Assimp::Importer m_importer;
    const aiScene* m_scene = nullptr;
};

} // namespace posewire::exporting
