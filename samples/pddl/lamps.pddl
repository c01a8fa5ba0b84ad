; The lamps above a table: a button turns its lamp and those that are wired to it.
(define (domain lamps)
  (:requirements :strips :typing :conditional-effects :quantified-preconditions
                 :negative-preconditions)
  (:types lamp)
  (:predicates (lit ?l - lamp) (wired ?l - lamp ?m - lamp) (power))

  (:action press
    :parameters (?l - lamp)
    :precondition (power)
    :effect (and
      (when (lit ?l) (not (lit ?l)))
      (when (not (lit ?l)) (lit ?l))
      (forall (?m - lamp)
        (and (when (and (wired ?l ?m) (lit ?m)) (not (lit ?m)))
             (when (and (wired ?l ?m) (not (lit ?m))) (lit ?m))))))

  (:action power-off
    :parameters ()
    :precondition (and (power) (forall (?l - lamp) (not (lit ?l))))
    :effect (not (power)))

  (:action power-on
    :parameters ()
    :precondition (not (power))
    :effect (power)))
