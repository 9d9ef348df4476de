#include "export/skybrush/light_loops.hpp"

#include <algorithm>
#include <unordered_map>

namespace aerogram::exporter {
namespace {

constexpr std::size_t kMostRounds = 255, kLoopBytes = 3;
constexpr char kLoop = 0x0C, kLoopEnd = 0x0D;

/// A step, or a loop of steps.
struct Item {
    std::string bytes;
    std::size_t depth = 0;  ///< of loops
};
using Items = std::vector<Item>;

Items with_loops(Items items, std::size_t depth);

/// Items, equal ones with equal numbers. A loop of the level before is an item of this one.
class Level {
  public:
    /// @param depth  that loops may have here.
    Level(const Items& items, std::size_t depth)
        : items_(items), depth_(depth), ids_(items.size()), costs_(items.size() + 1), too_deep_(items.size() + 1) {
        std::unordered_map<std::string_view, std::uint32_t> known;
        known.reserve(items.size());
        for (std::size_t i = 0; i < items.size(); ++i) {
            ids_[i] = known.try_emplace(items[i].bytes, static_cast<std::uint32_t>(known.size())).first->second;
            costs_[i + 1] = costs_[i] + items[i].bytes.size();
            too_deep_[i + 1] = too_deep_[i] + (items[i].depth >= depth ? 1U : 0U);
        }
    }

    /// The items with loops in them; as many as before when no loop pays.
    Items shortest() {
        choose();
        Items result;
        for (std::size_t i = 0; i < items_.size();) {
            const Choice& choice = choices_[i];
            if (choice.rounds == 1) {
                result.push_back(items_[i++]);
                continue;
            }
            result.push_back(loop(i, choice.body, choice.rounds));
            i += choice.body * choice.rounds;
        }
        return result;
    }

  private:
    struct Choice {
        std::size_t body = 1, rounds = 1;
    };

    /// From the end on: the fewest bytes from each item to the end, and what begins there.
    void choose() {
        const std::size_t n = items_.size(), longest = std::min(kLongestLoopBody, n / 2);
        choices_.assign(n, {});
        std::vector<std::size_t> best(n + 1, 0);
        std::vector<std::uint32_t> same(longest + 1,
                                        0);  ///< by period: how many items from here equal those a period on
        for (std::size_t i = n; i-- > 0;) {
            best[i] = costs_[i + 1] - costs_[i] + best[i + 1];
            const std::size_t reach = std::min(longest, n - 1 - i);
            const std::uint32_t id = ids_[i];
            for (std::size_t p = 1; p <= reach; ++p) same[p] = ids_[i + p] == id ? same[p] + 1 : 0;
            for (std::size_t p = 1; p <= reach; ++p)
                if (same[p] >= p) consider(i, p, same[p] / p + 1, best);
        }
    }

    void consider(std::size_t i, std::size_t body, std::size_t rounds, std::vector<std::size_t>& best) {
        if (too_deep_[i + body] > too_deep_[i]) return;
        rounds = std::min(rounds, kMostRounds);
        const std::size_t bytes = kLoopBytes + costs_[i + body] - costs_[i] + best[i + body * rounds];
        if (bytes >= best[i]) return;
        best[i] = bytes;
        choices_[i] = {body, rounds};
    }

    /// A loop whose body has loops of its own where that is shorter.
    [[nodiscard]] Item loop(std::size_t first, std::size_t body, std::size_t rounds) const {
        const auto begin = items_.begin() + static_cast<std::ptrdiff_t>(first);
        const Items inner = with_loops({begin, begin + static_cast<std::ptrdiff_t>(body)}, depth_ - 1);
        Item loop{{kLoop, static_cast<char>(rounds)}, 0};
        for (const Item& item : inner) {
            loop.bytes += item.bytes;
            loop.depth = std::max(loop.depth, item.depth);
        }
        loop.bytes += kLoopEnd;
        ++loop.depth;
        return loop;
    }

    const Items& items_;
    std::size_t depth_;
    std::vector<std::uint32_t> ids_;
    std::vector<std::size_t> costs_;     ///< bytes of the items before
    std::vector<std::size_t> too_deep_;  ///< how many items before can be in no loop
    std::vector<Choice> choices_;
};

Items with_loops(Items items, std::size_t depth) {
    while (depth > 0 && items.size() > 1) {
        Items shorter = Level(items, depth).shortest();
        if (shorter.size() == items.size()) break;
        items = std::move(shorter);
    }
    return items;
}

}  // namespace

std::vector<std::uint8_t> looped(std::span<const std::string> steps) {
    Items items;
    items.reserve(steps.size());
    for (const std::string& step : steps) items.push_back({step, 0});
    std::vector<std::uint8_t> bytes;
    for (const Item& item : with_loops(std::move(items), kLightLoopDepth))
        bytes.insert(bytes.end(), item.bytes.begin(), item.bytes.end());
    return bytes;
}

}  // namespace aerogram::exporter
