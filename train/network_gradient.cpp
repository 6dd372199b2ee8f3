#include "train/network_gradient.h"

#include <vector>

#include "simd/error.h"
#include "train/autograd_gradient.h"

namespace skein {
namespace {

class TiledGradient : public NetworkGradient {
 public:
  TiledGradient(const NetworkLayout& layout, int workers) : network_(layout), workers_(workers) {}

  void SetParameters(const float* parameters) override {
    parameters_.assign(parameters, parameters + network_.layout().size());
    network_.SetParameters(parameters);
  }

  std::int64_t accumulator_size() const override { return network_.folded_size(); }

  LossSums Accumulate(const SampleTile& tile, const LossSettings& settings, int worker,
                      float* accumulator) override {
    Worker& own = workers_[worker];
    const NetworkLayout& layout = network_.layout();
    const std::int64_t rows = tile.sequence.rows();
    const int outputs = layout.shape().output_size;
    network_.Forward(tile.sequence, own.workspace);
    own.output_gradient.resize(rows * outputs);
    const LossSums sums =
        layout.shape().gaussian
            ? ActorLoss(rows, outputs, settings, own.workspace.output(),
                        parameters_.data() + layout.log_std(), tile.actor,
                        own.output_gradient.data(), accumulator + network_.folded_log_std())
            : CriticLoss(rows, settings, own.workspace.output(), tile.target, tile.old_value,
                         own.output_gradient.data());
    network_.Backward(tile.sequence, own.output_gradient.data(), own.workspace, accumulator);
    return sums;
  }

  void Finish(const float* accumulator, float* gradient) const override {
    network_.UnfoldGradient(parameters_.data(), accumulator, gradient);
  }

 private:
  struct Worker {
    NetworkWorkspace workspace;
    AlignedVector<float> output_gradient;
  };

  TiledNetwork network_;
  std::vector<float> parameters_;
  std::vector<Worker> workers_;
};

}  // namespace

std::unique_ptr<NetworkGradient> MakeNetworkGradient(const std::string& backend,
                                                     const NetworkLayout& layout, int workers) {
  if (backend == "tiled") return std::make_unique<TiledGradient>(layout, workers);
  if (backend == "autograd") return MakeAutogradGradient(layout);
  throw Error("learner.backend is \"" + backend + "\"; one of: tiled, autograd");
}

}  // namespace skein
