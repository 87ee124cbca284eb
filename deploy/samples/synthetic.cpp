// The samples that daemons can make for themselves, as the writer wants them.

#include "common/synthetic/field.h"
#include "deploy/samples/formula.h"

namespace shearwater::samples {

namespace {

class Synthetic final : public Formula {
  public:
    Synthetic(std::string name, const volume::Index3& n, std::unique_ptr<const synthetic::Field> field)
        : name_(std::move(name)), n_(n), field_(std::move(field)) {}

    Description description() const override {
        return {.object = name_, .unit = "", .axes = {}, .keywords = {}};
    }

    void plane(std::int64_t z, std::span<float> out) const override {
        field_->fill({{0, 0, z}, {n_[0] - 1, n_[1] - 1, z}}, out);
    }

  private:
    std::string name_;
    volume::Index3 n_;
    std::unique_ptr<const synthetic::Field> field_;
};

}  // namespace

std::unique_ptr<Formula> make_synthetic(std::string_view name, const volume::Index3& n, std::uint64_t seed) {
    auto field = synthetic::make_field(name, n, seed);
    return field ? std::make_unique<Synthetic>(std::string(name), n, *std::move(field)) : nullptr;
}

}  // namespace shearwater::samples
