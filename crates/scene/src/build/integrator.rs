//! The sampler and the integrator.

use super::Builder;
use crate::desc::{
    IntegratorDesc, IntegratorName, LightSamplerName, RandomizeName, RouletteName, SamplerDesc, SamplerName,
};
use crate::params::Params;
use sparrow_mis::{Heuristic, Mis};

impl Builder {
    /// The sampler.
    pub(super) fn make_sampler(&mut self) -> SamplerDesc {
        let Some(statement) = self.setup.sampler.take() else {
            return SamplerDesc {
                name: SamplerName::ZSobol,
                samples_per_pixel: 16,
                strata: [4, 4],
                jitter: true,
                randomize: RandomizeName::FastOwen,
                seed: None,
            };
        };
        let p = &statement.params;
        let name = match statement.entity.name {
            "independent" => SamplerName::Independent,
            "stratified" => SamplerName::Stratified,
            "halton" => SamplerName::Halton,
            "sobol" => SamplerName::Sobol,
            "paddedsobol" => SamplerName::PaddedSobol,
            "pmj02bn" => SamplerName::Pmj02bn,
            _ => SamplerName::ZSobol,
        };
        let strata = ["xsamples", "ysamples"].map(|n| self.count_of_samples(p, n, 4));
        let samples_per_pixel = match name {
            SamplerName::Stratified => strata[0].saturating_mul(strata[1]),
            SamplerName::Independent => self.count_of_samples(p, "pixelsamples", 4),
            SamplerName::Halton | SamplerName::Sobol | SamplerName::PaddedSobol => {
                self.count_of_samples(p, "pixelsamples", 16)
            }
            SamplerName::ZSobol | SamplerName::Pmj02bn => self.count_of_samples(p, "pixelsamples", 16),
        };
        SamplerDesc {
            name,
            samples_per_pixel,
            strata,
            jitter: p.bool_or("jitter", true),
            randomize: self.randomization(p, name),
            // A negative seed is as good as any other.
            seed: p.int("seed").map(|s| i64::from(s) as u64),
        }
    }

    fn count_of_samples(&mut self, p: &Params, name: &str, default: i32) -> u32 {
        match p.int(name).unwrap_or(default) {
            n @ 1.. => n as u32,
            n => {
                self.report.error(p.place(name), format!("\"{name}\" is {n}; give at least one sample"));
                1
            }
        }
    }

    fn randomization(&mut self, p: &Params, name: SamplerName) -> RandomizeName {
        let all = [
            ("none", RandomizeName::None),
            ("permutedigits", RandomizeName::PermuteDigits),
            ("fastowen", RandomizeName::FastOwen),
            ("owen", RandomizeName::Owen),
        ];
        if name == SamplerName::Halton {
            // Fast Owen scrambling works in base two only.
            let names = [all[0], all[1], all[3]];
            return self.choice(p, "randomization", &names, "permutedigits").unwrap_or(RandomizeName::None);
        }
        self.choice(p, "randomization", &all, "fastowen").unwrap_or(RandomizeName::FastOwen)
    }

    /// The integrator. pbrt-v4 takes `volpath` where none is named, which without media is `path`.
    pub(super) fn make_integrator(&mut self) -> IntegratorDesc {
        let mut desc = IntegratorDesc {
            name: IntegratorName::Path,
            max_depth: 5,
            light_sampler: LightSamplerName::Bvh,
            regularize: false,
            splits: None,
            mis: Mis::Both(Heuristic::Power(2.0)),
            mis_compensation: true,
            roulette: RouletteName::Throughput,
        };
        let Some(statement) = self.setup.integrator.take() else { return desc };
        let p = &statement.params;
        desc.name = match statement.entity.name {
            "directlighting" => IntegratorName::DirectLighting,
            "reference" => IntegratorName::Reference,
            _ => IntegratorName::Path,
        };
        match p.int("maxdepth") {
            Some(depth @ 0..) => desc.max_depth = depth as u32,
            Some(depth) => {
                let message = format!("\"maxdepth\" is {depth}; give one from 0");
                self.report.error(p.place("maxdepth"), message);
            }
            None => {}
        }
        desc.light_sampler = self.light_sampler(p);
        desc.regularize = p.bool_or("regularize", false);
        match p.int("splits") {
            None | Some(0) => {}
            Some(n @ 1..) if n <= IntegratorDesc::MAX_SPLITS as _ => desc.splits = Some(n as u32),
            Some(n) => {
                let most = IntegratorDesc::MAX_SPLITS;
                let message = format!(
                    "\"splits\" is {n}; give one from 1 to {most}, or 0 for as many as are efficient"
                );
                self.report.error(p.place("splits"), message);
            }
        }
        desc.mis_compensation = p.bool_or("miscompensation", true);
        desc.mis = self.mis(p).unwrap_or(desc.mis);
        let roulettes = [("throughput", RouletteName::Throughput), ("efficiency", RouletteName::Efficiency)];
        desc.roulette = self.choice(p, "roulette", &roulettes, "throughput").unwrap_or(desc.roulette);
        desc
    }

    fn light_sampler(&mut self, p: &Params) -> LightSamplerName {
        let names = [
            ("uniform", LightSamplerName::Uniform),
            ("power", LightSamplerName::Power),
            ("bvh", LightSamplerName::Bvh),
            ("exhaustive", LightSamplerName::Bvh),
        ];
        if let Some(("exhaustive", at)) = p.text("lightsampler") {
            self.report.warn(at, "the light sampler \"exhaustive\" is not supported yet; \"bvh\" is used");
        }
        self.choice(p, "lightsampler", &names, "bvh").unwrap_or(LightSamplerName::Bvh)
    }

    /// The heuristic; switching one technique off leaves all to the other.
    fn mis(&mut self, p: &Params) -> Option<Mis> {
        let named = match p.text("mis") {
            Some((name, at)) => {
                let mis = name.parse();
                mis.map_err(|e| self.report.error(at, e)).ok()
            }
            None => None,
        };
        match (p.bool_or("samplelights", true), p.bool_or("samplebsdf", true)) {
            (true, true) => named,
            (true, false) => Some(Mis::LightOnly),
            (false, true) => Some(Mis::BsdfOnly),
            (false, false) => {
                let message =
                    "neither lights nor the BSDF are sampled; set \"samplelights\" or \"samplebsdf\" to true";
                self.report.error(p.place("samplebsdf"), message.to_string());
                None
            }
        }
    }
}
