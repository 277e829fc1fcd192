use crate::case::Case;
use crate::explain::Forecast;
use crate::request::RunFailure;
use crate::resolve::Setup;
pub(crate) fn plan(_: &Case, _: &Setup) -> Result<Forecast, RunFailure> {
    Err(RunFailure::Run(String::new()))
}
pub(crate) fn build(_: &Case, _: &Setup) -> Result<Box<dyn physics::Scheme>, RunFailure> {
    Err(RunFailure::Run(String::new()))
}
