//! Whether what is to be made of a file is in proportion to it and to this machine.

use crate::error::Error;
use crate::limits;
use crate::read::ParticleFile;

impl ParticleFile {
    /// Refuses a file from which `what`, of so many bytes, would be made although the file is
    /// too small to be worth them: a header can claim any box.
    pub fn is_worth(&self, bytes: u64, what: &str) -> Result<(), Error> {
        let len = self.len_bytes();
        let most = limits::made_of(len);
        if bytes <= most {
            return Ok(());
        }
        let [x, y, z] = self.header().span();
        Err(self.corrupt(format!(
            "has {len} bytes and claims a box of {x} x {y} x {z} voxels: {what} would take \
             {bytes} bytes, and at most {most} are made of it ({} and {} for each of its bytes)",
            limits::MADE_AT_LEAST,
            limits::MADE_PER_BYTE
        )))
    }

    /// Refuses a file from which `what`, of so many bytes, would be made although they are not to be
    /// had here.
    pub fn fits(&self, bytes: u64, what: &str) -> Result<(), Error> {
        match machine::shortage(bytes) {
            None => Ok(()),
            Some(short) => Err(self.corrupt(format!("is too large: {what} would take {short}"))),
        }
    }
}
