#include "apps/studies/dataset/dataset_settings.hpp"

#include <nlohmann/json.hpp>

namespace listric {

PlanTable<DatasetSettings> dataset_settings() {
    using S = DatasetSettings;
    constexpr Range size{.from = 16, .to = 8192};
    return {
        "labelled seismic sections, one of each run (listric dataset)",
        {plan_key("split_by", at<&S::split_by>, "parameter whose values are in one split each"),
         plan_key("validation", at<&S::validation>, "its values of the split for validation"),
         plan_key("test", at<&S::test>, "its values of the split for tests"),
         plan_key("licence", at<&S::licence>, "of the data set, for its card"),
         plan_key("author", at<&S::author>, "of the data set, for its card"),
         plan_key("traces", at<&S::traces>, "of a section, from the breakaway on", size),
         plan_key("samples", at<&S::samples>, "of a trace", size),
         plan_key("trace_spacing_m", at<&S::trace_spacing>, "between traces", between(1, 1e3), "m"),
         plan_key("in_depth", at<&S::in_depth>, "samples by depth instead of two-way time"),
         plan_key("sample_interval_s", at<&S::sample_interval>, "of time", between(5e-4, 0.1), "s"),
         plan_key("sample_interval_m", at<&S::depth_interval>, "of depth", between(0.5, 100), "m"),
         plan_key("frequency_hz", at<&S::frequency>, "least and greatest of the wavelet",
                  between(1, 1e3), "Hz"),
         plan_key("quality", at<&S::quality>, "least and greatest Q of rock", between(5, 1e6)),
         plan_key("noise", at<&S::noise>, "least and greatest noise over reflections, both as rms",
                  between(0, 10)),
         plan_key("lateral_m", at<&S::lateral>, "least and greatest width of the point spread",
                  between(0, 1e4), "m"),
         plan_key("layer_m", at<&S::layer>, "least and greatest thickness of pre-rift layers",
                  between(20, 1e4), "m"),
         plan_key("contrast", at<&S::contrast>, "standard deviation of layers' velocities",
                  between(0, 0.3)),
         plan_key("fault_width_samples", at<&S::fault_width>, "of a line in the mask",
                  between(1, 100)),
         plan_key("least_throw_m", at<&S::least_throw>, "of a fault that is marked",
                  between(0, 1e4), "m"),
         plan_key("least_height_m", at<&S::least_height>, "of what is marked of a fault",
                  between(0, 1e5), "m"),
         plan_key("certain_throw_m", at<&S::certain_throw>,
                  "median of that of a fault that is not doubtful", between(0, 1e4), "m"),
         plan_key("certain_height_m", at<&S::certain_height>, "of a fault that is not doubtful",
                  between(0, 1e5), "m")},
        {"split_by"}};
}

nlohmann::ordered_json dataset_schema() { return dataset_settings().schema(); }

} // namespace listric
