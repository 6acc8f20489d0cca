#include "simulate/forward/path_vertices.h"

#include "core/parallel.h"
#include "simulate/transport/estimate.h"

namespace bpms {
namespace {

constexpr std::uint64_t largest_vertex_wave = 1 << 15;

// A Sink (photon_wave.h).
class VertexSink {
 public:
  VertexSink(const PhotonStage& stage, std::size_t source, std::size_t batch, int orders, PathVertices& to)
      : bands_(stage.optics.bands),
        source_(source),
        sky_(!stage.sources[source].is_sun),
        batch_(batch),
        orders_(orders),
        to_(&to) {}
  void arrive(const Photon& photon, const float* weight, int order) {
    if (order == 0 && !sky_) return;
    PathVertex& v = to_->list.emplace_back();
    v.position = photon.position;
    v.normal = photon.normal;
    v.instance = photon.surface.instance;
    v.primitive = photon.surface.primitive;
    v.geometry = static_cast<std::uint8_t>(photon.surface.geometry);
    v.sample = photon.sample;
    v.material = static_cast<std::uint16_t>(photon.material);
    v.order = static_cast<std::uint8_t>(std::min(order + 1, orders_));
    v.batch = static_cast<std::uint8_t>(batch_ & 31u);
    v.front = photon.front;
    v.ground = photon.ground;
    v.source = static_cast<std::uint8_t>(source_);
    to_->weights.insert(to_->weights.end(), weight, weight + bands_);
  }
  void absorb(const Photon&, const float*) {}
  void leave(const Photon&, const float*, int, Exit) {}

 private:
  std::size_t bands_, source_;
  bool sky_;
  std::size_t batch_;
  int orders_;
  PathVertices* to_;
};

}  // namespace

PathVertices trace_vertices(const PhotonStage& stage, const std::vector<const ParallelRays*>& sun_rays,
                            std::uint64_t seed, std::uint32_t stream, int orders, std::uint64_t first,
                            std::uint64_t last) {
  static_assert(batches <= 32);  // PathVertex::batch
  const std::size_t bands = stage.optics.bands;
  std::vector<PathVertices> pieces(stage.sources.size() * batches);
  parallel_for(pieces.size(), [&](std::size_t i) {
    const std::size_t s = i / batches, batch = i % batches;
    VertexSink sink(stage, s, batch, orders, pieces[i]);
    PhotonWave<VertexSink> wave(stage, sink);
    for (std::uint64_t from = first; from < last; from += largest_vertex_wave)
      wave.run(stage.sources[s], sun_rays[s], {seed, stream, s}, static_cast<std::uint32_t>(batch), from,
               std::min(last, from + largest_vertex_wave));
    pieces[i].rays = wave.rays();
  });
  // Sorted all together.
  std::vector<std::size_t> begin;
  std::size_t count = 0;
  PathVertices out;
  for (const PathVertices& piece : pieces) {
    begin.push_back(count);
    count += piece.list.size();
    out.rays += piece.rays;
  }
  std::vector<std::uint64_t> places(count), spare;
  std::vector<std::uint16_t> piece_of(count);
  const MortonCurve curve(stage.extent);
  parallel_for(pieces.size(), [&](std::size_t i) {
    for (std::size_t k = 0; k < pieces[i].list.size(); ++k) {
      const std::size_t at = begin[i] + k;
      places[at] = std::uint64_t{curve.place(pieces[i].list[k].position)} << 32 | at;
      piece_of[at] = static_cast<std::uint16_t>(i);
    }
  });
  sort_places(places, spare);
  out.list.resize(count);
  out.weights.resize(count * bands);
  constexpr std::size_t block = 1 << 16;
  parallel_for((count + block - 1) / block, [&](std::size_t b) {
    for (std::size_t to = b * block; to < std::min(count, (b + 1) * block); ++to) {
      const std::size_t from = places[to] & index_of_place;
      const PathVertices& piece = pieces[piece_of[from]];
      const std::size_t k = from - begin[piece_of[from]];
      out.list[to] = piece.list[k];
      std::copy_n(piece.weights.data() + k * bands, bands, out.weights.data() + to * bands);
    }
  });
  return out;
}

}  // namespace bpms
