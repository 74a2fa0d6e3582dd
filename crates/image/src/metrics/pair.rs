//! What is compared: [`Pair`].

use crate::ImageError;

/// A picture and its reference: linear RGB of the same size, row by row from the top left.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    width: usize,
    picture: &'a [[f32; 3]],
    reference: &'a [[f32; 3]],
}

impl<'a> Pair<'a> {
    /// `width` is that of both pictures.
    ///
    /// # Errors
    /// [`ImageError::Mismatch`] where the pictures differ in size, are empty or not made of whole rows.
    pub fn new(
        width: usize,
        picture: &'a [[f32; 3]],
        reference: &'a [[f32; 3]],
    ) -> Result<Pair<'a>, ImageError> {
        if picture.len() != reference.len() || picture.is_empty() {
            return Err(ImageError::Mismatch(format!(
                "pictures of {} and {} pixels cannot be compared; render both at the same resolution",
                picture.len(),
                reference.len()
            )));
        }
        if width == 0 || !picture.len().is_multiple_of(width) {
            return Err(ImageError::Mismatch(format!(
                "{} pixels do not make rows of {width}; give the width of the pictures",
                picture.len()
            )));
        }
        Ok(Pair { width, picture, reference })
    }

    /// Pixels in a row.
    pub fn width(&self) -> usize {
        self.width
    }
    /// The picture.
    pub fn picture(&self) -> &'a [[f32; 3]] {
        self.picture
    }
    /// What it is held against.
    pub fn reference(&self) -> &'a [[f32; 3]] {
        self.reference
    }

    /// Pixels of both, side by side.
    pub(super) fn pixels(&self) -> impl Iterator<Item = ([f64; 3], [f64; 3])> + use<'a> {
        let wide = |p: &[f32; 3]| p.map(f64::from);
        self.picture.iter().map(wide).zip(self.reference.iter().map(wide))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_that_do_not_fit_are_refused() {
        let (a, b) = (vec![[0.0; 3]; 4], vec![[0.0; 3]; 5]);
        assert!(Pair::new(2, &a, &b).unwrap_err().to_string().contains("same resolution"));
        assert!(Pair::new(0, &[], &[]).is_err());
        assert!(Pair::new(3, &a, &a).is_err() && Pair::new(0, &a, &a).is_err());
        assert_eq!(Pair::new(2, &a, &a).unwrap().width(), 2);
    }
}
