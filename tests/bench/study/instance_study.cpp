// Writes an instance for the Python peers: n rows of six little-endian float64, from x y z then to x y z, m.
#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "tests/bench/study/instances.hpp"
#include "tests/bench/study/study.hpp"

namespace aerogram::study {
namespace {

Json write_instance(const Arguments& arguments) {
    const std::string& name = arguments.word(0);
    const std::size_t n = arguments.count(1);
    const Instance instance = make_instance(name, n);
    const double spacing_m = std::min(smallest_spacing_m(instance.from_m), smallest_spacing_m(instance.to_m));
    if (instance.from_m.size() != n || instance.to_m.size() != n || spacing_m < kSpacing_m - 1e-9)
        throw std::runtime_error("the instance is not as promised");
    std::ofstream file(arguments.word(2), std::ios::binary);
    for (std::size_t i = 0; i < n; ++i)
        for (const Vec3* p : {&instance.from_m[i], &instance.to_m[i]})
            file.write(reinterpret_cast<const char*>(p), sizeof *p);
    if (!file.flush()) throw std::runtime_error("cannot write " + arguments.word(2));
    return Json{}.add("instance", name).add("n", static_cast<double>(n)).add("spacing_m", spacing_m);
}

const Study kInstance{"instance", "INSTANCE N FILE", "grid-letters 60 instance.bin", write_instance};

}  // namespace
}  // namespace aerogram::study
