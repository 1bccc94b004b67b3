// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: every search method, with one thread and with two, finds the same pairs of overlapping
// boxes as the comparison of all pairs: sorted, each once.
#include "bytes.hpp"
#include "report.hpp"

#include <terrane/algorithms/search/search.hpp>

#include <algorithm>
#include <cmath>
#include <random>

using namespace terrane;
using fuzz::Bytes;
using fuzz::require;

namespace {

using Boxes = std::vector<Box>;
using Groups = std::vector<std::uint32_t>;
using Pairs = std::vector<CandidatePair>;

Box around(const fuzzing::Point& a, const fuzzing::Point& b) {
    return {{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
            {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
}

/// Returns the length of a side of a box: a small integer, zero, or a far smaller or larger number.
double side(Bytes& bytes) {
    const unsigned byte = bytes.byte();
    if (byte < 200) return byte % 4;
    return std::ldexp(1, static_cast<int>(byte) - 232);
}

/// Adds one box, or a row of boxes that touch or overlap.
void add_boxes(Boxes& boxes, const fuzzing::Frame& frame, Bytes& bytes) {
    const unsigned kind = bytes.byte();
    fuzzing::Point low{double(bytes.between(-16, 16)), double(bytes.between(-16, 16)),
                       double(bytes.between(-16, 16))};
    const fuzzing::Point size{side(bytes), side(bytes), side(bytes)};
    const unsigned copies = kind < 192 ? 1 : 1 + kind % 32;
    const double step = kind % 3 == 0 ? 1 : kind % 3 == 1 ? size.x : 0.5;
    for (unsigned i = 0; i < copies; ++i) {
        boxes.push_back(
            around(frame(low), frame({low.x + size.x, low.y + size.y, low.z + size.z})));
        (kind & 8 ? low.y : low.x) += step;
    }
}

Groups any_groups(Bytes& bytes, std::size_t count) {
    const unsigned kind = bytes.byte();
    if (kind % 4 == 0) return {};
    Groups groups;
    for (std::size_t i = 0; i < count; ++i) {
        const unsigned byte = kind % 4 == 1 ? static_cast<unsigned>(i) % 2 : bytes.byte();
        groups.push_back(kind % 4 == 3 && byte % 5 == 0 ? no_group : byte % (kind < 200 ? 3 : 200));
    }
    return groups;
}

bool parted(const Groups& groups, std::uint32_t i, std::uint32_t j) {
    return groups.empty() || groups[i] == no_group || groups[i] != groups[j];
}

bool meet(const Box& a, const Box& b) {
    for (unsigned k = 0; k < 3; ++k)
        if (std::max(a.low[k], b.low[k]) > std::min(a.high[k], b.high[k])) return false;
    return true;
}

/// Compares every box with those that begin along x before it ends.
Pairs expected(const Boxes& boxes, const Groups& groups) {
    Groups order(boxes.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t i, std::uint32_t j) { return boxes[i].low[0] < boxes[j].low[0]; });
    Pairs pairs;
    for (std::size_t a = 0; a < order.size(); ++a)
        for (std::size_t b = a + 1; b < order.size(); ++b) {
            const std::uint32_t i = order[a], j = order[b];
            if (boxes[j].low[0] > boxes[i].high[0]) break;
            if (meet(boxes[i], boxes[j]) && parted(groups, i, j))
                pairs.push_back({std::min(i, j), std::max(i, j)});
        }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

void check_active(const Boxes& boxes, const Groups& groups, const Pairs& all, Bytes& bytes) {
    Groups active;
    const unsigned share = 1 + bytes.below(4);
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        if (bytes.byte() % share == 0) active.push_back(i);
    const auto is_active = [&](std::uint32_t i) {
        return std::binary_search(active.begin(), active.end(), i);
    };
    const auto odd = [](const CandidatePair& p) { return (p.first + p.second) % 2 != 0; };
    Pairs right, filtered;
    for (const CandidatePair& p : all)
        if (is_active(p.first) || is_active(p.second)) right.push_back(p);
    std::copy_if(right.begin(), right.end(), std::back_inserter(filtered), odd);
    const Run two{.threads = 2};
    require(candidate_pairs_of(boxes, active, groups) == right, "pairs of active boxes differ");
    require(candidate_pairs_of(boxes, active, groups, odd, two) == filtered,
            "filtered pairs of active boxes differ");
}

/// Checks enough small boxes for threads to share the work.
void check_many(Bytes& bytes) {
    bytes.byte();
    bytes.byte();
    std::minstd_rand random(bytes.byte());
    std::uniform_int_distribution<int> place(0, 400), size(0, 6);
    Boxes boxes;
    for (int i = 0; i < 20000; ++i) {
        Box b{};
        for (unsigned k = 0; k < 3; ++k) {
            b.low[k] = place(random);
            b.high[k] = b.low[k] + size(random);
        }
        boxes.push_back(b);
    }
    Groups groups;
    if (bytes.flag())
        for (std::uint32_t i = 0; i < boxes.size(); ++i) groups.push_back(i / 3000);
    require(candidate_pairs(boxes, groups, Search::bvh, {.threads = 2}) == expected(boxes, groups),
            "many boxes with two threads: the pairs differ");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    if (size >= 2 && data[0] == 255 && data[1] == 255 && size < 5) { // seldom: it is slow
        check_many(bytes);
        return 0;
    }
    const fuzzing::Frame frame(bytes);
    Boxes boxes;
    const std::size_t most = bytes.below(96);
    while (boxes.size() < most && !bytes.empty()) add_boxes(boxes, frame, bytes);
    for (const Groups& groups : {Groups(), any_groups(bytes, boxes.size())}) {
        const Pairs right = expected(boxes, groups);
        for (int m = 0; m <= static_cast<int>(Search::brute); ++m) {
            const auto method = static_cast<Search>(m);
            const std::string name(name_of(method));
            if (candidate_pairs(boxes, groups, method) != right) fuzz::fail(name + " differs");
        }
        // This is the only method that uses threads.
        require(candidate_pairs(boxes, groups, Search::bvh, {.threads = 2}) == right,
                "hierarchy with two threads differs");
        check_active(boxes, groups, right, bytes);
    }
    return 0;
}
