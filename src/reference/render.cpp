// How far the picture is, shared by the threads that make it.
class Progress {
public:
  explicit Progress(const RenderSettings& settings) : settings_(&settings) {}

  bool stopped() {
    const std::lock_guard lock(mutex_);
    if (settings_->cancelled != nullptr && settings_->cancelled->load()) stopped_ = true;
    return stopped_;
  }

  void row_done(const RayCounts& rays) {
    const std::lock_guard lock(mutex_);
    rays_.primary += rays.primary;
    rays_.shadow += rays.shadow;
    rays_.reflected += rays.reflected;
    rays_.refracted += rays.refracted;
    ++rows_done_;
    if (settings_->progress) settings_->progress(static_cast<double>(rows_done_) / settings_->height);
  }

  // Exceptions must not leave a parallel region; the first one leaves through finish().
  void failed(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    if (!error_) error_ = std::move(error);
  }

  void finish(Frame& frame) {
    if (error_) std::rethrow_exception(error_);
    frame.rays = rays_;
    frame.complete = rows_done_ == settings_->height;
  }

private:
  const RenderSettings* settings_;
  std::mutex mutex_;
  RayCounts rays_;
  int rows_done_ = 0;
  bool stopped_ = false;
  std::exception_ptr error_;
};

} // namespace

Frame render(const Scene& scene, const HitFinder& finder, const Camera& camera,
             const RenderSettings& settings) {
  check(settings);
  const Job job{&scene, &finder, &settings, make_camera_frame(camera, settings.width, settings.height)};
  Frame frame = black_frame(settings.width, settings.height);
  Progress progress(settings);
  const int threads = settings.threads > 0 ? settings.threads : omp_get_max_threads();
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (int y = 0; y < settings.height; ++y) {
    try {
      if (!progress.stopped()) progress.row_done(render_row(job, y, frame));
    } catch (...) {
      progress.failed(std::current_exception());
    }
  }
  progress.finish(frame);
  return frame;
}

} // namespace reference

Frame render_reference(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
  return reference::render(scene, reference::BruteForce(scene), camera, settings);
}

} // namespace fastrt
